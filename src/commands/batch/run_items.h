// Runs the items of a list, several at a time, each in a process of its own.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "commands/batch/item.h"
#include "commands/batch/journal.h"
#include "commands/batch/outcome.h"
#include "commands/batch/shared_list.h"

namespace ibmfair::commands {

struct RunSettings {
  int jobs = 1;     ///< at a time, at least 1
  int threads = 1;  ///< of every item that does not say
  bool fail_fast = false;
  bool resume = false;  ///< what `earlier` runs have done is skipped or replaced
  bool overwrite = false;
  std::string list_journal;  ///< of the whole list, from where the keys of items are seen
};

struct RunObserver {
  /// Called as each item ends, in the order in which they do, with its place in the list.
  std::function<void(std::size_t index, const Outcome& outcome)> ended;
  /// Called once when other processes have all items that are left, with their number.
  std::function<void(std::size_t items)> waits;
};

struct RunResult {
  std::vector<Outcome> outcomes;  ///< one an item
  int signal_number = 0;          ///< that stopped the batch; 0: none
};

/// Runs the items. Where they are `shared` with other processes (null: they are not), each is run
/// by one of them; what another has failed at has failed, also before unless this is to `resume`;
/// and it takes until all of these items have ended. Throws CannotWrite where the journal cannot be
/// written. Whatever happens, no process is left behind.
RunResult run_items(const std::vector<Item>& items, const RunSettings& settings,
                    const JournalRecord& earlier, Journal& journal, SharedList* shared,
                    const RunObserver& observer);

}  // namespace ibmfair::commands
