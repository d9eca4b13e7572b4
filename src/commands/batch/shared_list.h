// A list that several processes, on several machines, run together.
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

/// What this process knows of the others, and they of it: claims to items, and journals, one a
/// process, in a folder beside the journal of the list.
class SharedList {
 public:
  /// `earlier` is what this process knows already. Throws CannotWrite where the folder cannot be
  /// used.
  SharedList(const std::string& list_journal, double claim_expiry, const JournalRecord& earlier);
  /// Removes the journal where nothing has been noted in it.
  ~SharedList();
  SharedList(const SharedList&) = delete;
  SharedList& operator=(const SharedList&) = delete;

  /// Name of a new file that is this process's own.
  const std::string& journal() const { return journal_; }

  /// How the item ended where another process has run it since this one began, as far as is known.
  std::optional<Outcome> ended(const Item& item, const std::string& key) const;

  /// Whether another process has begun it since.
  bool started(const std::string& key) const { return news_.started(key); }

  /// The right to run the item of this key; null where another process has it. Afterwards all that
  /// others have noted of the item is known.
  std::unique_ptr<Claim> claim(const std::string& key);

  /// Removes what is left of claims to items that have ended.
  void clear_up(const std::vector<std::string>& keys);

  /// How long to leave an item alone that others have, at most.
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
