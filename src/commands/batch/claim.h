// Claim files, by which processes on several machines agree on which process runs an item.
//
// A claim is a file that gets its name by link(), which succeeds for only one of several processes
// that try at the same time. The modification time of the file is the last sign of life of its
// holder, the process that made the claim. A claim is void if its last sign of life is older than
// the expiry, or if its holder was a process of this machine that has ended. Other processes never
// remove or change a void claim, because their knowledge of the claim may be out of date. Instead
// they make a successor: a file whose name contains the mark of the void claim, which no later
// claim has. So the claims to an item form a chain, from `ITEM.claim` to its successor
// `ITEM-MARK.claim` and so on, and the last claim of the chain is the valid one. A process that
// finds another claim at the end of the chain has lost its own claim.
//
// All ages are measured by one clock, that of the file system, because the clocks of the machines
// may differ.
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

/// A process that ran an item and ended without giving up its claim.
struct AbandonedRun {
  pid_t process = 0;
  std::int64_t end = 0;  ///< a time by which it had ended; nanoseconds, as in FileStamp
};

/// The claim of this process to an item. The destructor gives the claim up.
class Claim {
 public:
  /// Claims the item with this key; returns null if another process holds a valid claim.
  /// `heartbeat` renews the claim regularly. Throws CannotWrite if the folder cannot be used.
  static std::unique_ptr<Claim> take(const ClaimFolder& folder, const std::string& key,
                                     Heartbeat& heartbeat);
  ~Claim();
  Claim(const Claim&) = delete;
  Claim& operator=(const Claim&) = delete;

  /// Checks whether the claim is lost; if it is not, sets its last sign of life to now.
  void renew();

  /// Whether another process has taken over the item because this process did not renew its claim
  /// in time, for example because it was suspended.
  bool lost() const { return lost_; }

  /// Writes into the claim which process runs the item, so that a later holder can remove the
  /// temporary files of that process.
  void note_process(pid_t process) const;

  /// The processes that ran the item before and ended without finishing it.
  const std::vector<AbandonedRun>& abandoned() const { return abandoned_; }

 private:
  explicit Claim(Heartbeat& heartbeat) : heartbeat_(heartbeat) {}
  bool make(const ClaimFolder& folder, const std::string& key);
  bool is_removed() const;

  Heartbeat& heartbeat_;
  std::vector<std::string> chain_;  // names from the first claim to this one
  std::string mark_;                // of this claim
  std::string successor_;           // name that a successor of this claim would have
  std::vector<AbandonedRun> abandoned_;
  int fd_ = -1;
  std::atomic<bool> lost_ = false;
};

/// Removes the claims that ended processes have left to these items. All items must have ended; a
/// claim remains if its holder was killed after it had recorded the end of the item.
void remove_left_claims(const ClaimFolder& folder, const std::vector<std::string>& keys,
                        Heartbeat& heartbeat);

}  // namespace ibmfair::commands
