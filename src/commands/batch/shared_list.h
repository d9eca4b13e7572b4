// A list of items that several processes, possibly on several machines, run together.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands/batch/claim.h"
#include "commands/batch/heartbeat.h"
#include "commands/batch/item.h"
#include "commands/batch/journal.h"
#include "commands/batch/outcome.h"

namespace ibmfair::commands {

/// The information that the processes exchange: claims to items, and one journal per process, in a
/// folder beside the journal of the list.
class SharedList {
 public:
  /// `earlier` holds the records that this process has already read. Throws CannotWrite if the
  /// folder cannot be used.
  SharedList(const std::string& list_journal, double claim_expiry, const JournalRecord& earlier);
  /// Removes the journal of this process if it is empty.
  ~SharedList();
  SharedList(const SharedList&) = delete;
  SharedList& operator=(const SharedList&) = delete;

  /// The path of the journal of this process, a new file.
  const std::string& journal() const { return journal_; }

  /// The outcome of the item if another process has run it since this process started; nothing if
  /// there is none in the records read so far.
  std::optional<Outcome> ended(const Item& item, const std::string& key) const;

  /// Whether another process has started the item since this process started.
  bool started(const std::string& key) const { return news_.started(key); }

  /// Claims the item with this key; null if another process holds the claim. With the claim, all
  /// records that other processes have written about the item are read.
  std::unique_ptr<Claim> claim(const std::string& key);

  /// Removes remaining claims to these items, all of which must have ended.
  void clear_up(const std::vector<std::string>& keys);

  /// The longest pause before an item that another process holds is tried again.
  std::chrono::milliseconds longest_pause() const;

 private:
  void read_news();

  std::string list_journal_;
  ClaimFolder folder_;
  std::string journal_;
  JournalRecord news_;
  Heartbeat heartbeat_;
};

}  // namespace ibmfair::commands
