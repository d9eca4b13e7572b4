// Files by which processes on several machines agree on which of them runs an item.
//
// A claim is a file that is made under its name by link(), which lets one process through however
// many try. Its modification time is the last sign of life of the process that holds it. A claim
// without one for longer than the expiry, or of a process of this machine that has ended, counts
// for nothing. Others, who might have looked at it a while ago, never remove or change it: its
// successor is the file whose name holds the mark of that very claim, which no later one has. So an
// item has a chain of claims, from `ITEM.claim` to its successor `ITEM-MARK.claim` and so on, the
// last of which is the one that is held. Whoever finds that his own is not the end of the chain has
// come too late.
//
// Ages are told by one clock, that of the file system, as those of the machines may differ.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <sys/types.h>

namespace ibmfair::commands {

class Heartbeat;

struct ClaimFolder {
  std::string path;
  double expiry = 0;  ///< seconds
};

/// A process that ran an item and ended without giving its claim up.
struct AbandonedRun {
  pid_t process = 0;
  std::int64_t end = 0;  ///< it was dead by then, in nanoseconds as FileStamp has them
};

/// The claim of this process to an item, which is given up at its end.
class Claim {
 public:
  /// Null where another process holds the item of this key. `heartbeat` keeps the claim alive.
  /// Throws CannotWrite where the folder cannot be used.
  static std::unique_ptr<Claim> take(const ClaimFolder& folder, const std::string& key,
                                     Heartbeat& heartbeat);
  ~Claim();
  Claim(const Claim&) = delete;
  Claim& operator=(const Claim&) = delete;

  /// Gives a sign of life, unless the claim is lost.
  void renew();

  /// Whether another process has taken the item over, because this one, asleep perhaps, has given
  /// no sign for too long.
  bool lost() const { return lost_; }

  /// Notes which process runs the item, for those who might have to clear up after it.
  void note_process(pid_t process) const;

  /// Those who have run the item before and left it.
  const std::vector<AbandonedRun>& abandoned() const { return abandoned_; }

 private:
  explicit Claim(Heartbeat& heartbeat) : heartbeat_(heartbeat) {}
  bool make(const ClaimFolder& folder, const std::string& key);
  bool is_removed() const;

  Heartbeat& heartbeat_;
  std::vector<std::string> chain_;  // names from the first claim to this one
  std::string mark_;                // of this one
  std::string successor_;           // name of the one that would take this one's place
  std::vector<AbandonedRun> abandoned_;
  int fd_ = -1;
  std::atomic<bool> lost_ = false;
};

/// Removes what processes that are gone have left of their claims to these items, all of which have
/// ended: one can be killed after it has noted the end.
void remove_left_claims(const ClaimFolder& folder, const std::vector<std::string>& keys,
                        Heartbeat& heartbeat);

}  // namespace ibmfair::commands
