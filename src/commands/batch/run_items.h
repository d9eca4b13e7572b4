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
  int jobs = 1;     ///< number of items to run at the same time, at least 1
  int threads = 1;  ///< threads of every item that does not set --threads
  bool fail_fast = false;
  bool resume = false;  ///< skip items that earlier runs have finished, redo the others
  bool overwrite = false;
  std::string list_journal;  ///< path; the keys of items are relative to its folder
};

struct RunObserver {
  /// Called at the end of each item, in the order in which the items end, with the index of the
  /// item in the list.
  std::function<void(std::size_t index, const Outcome& outcome)> ended;
  /// Called at most once, when all remaining items are run by other processes, with their number.
  std::function<void(std::size_t items)> waits;
};

struct RunResult {
  std::vector<Outcome> outcomes;  ///< one per item
  int signal_number = 0;          ///< signal that stopped the batch; 0: none
};

/// Runs the items. If `shared` is not null, other processes run the same list, and each item is run
/// by one of the processes. An item that another process failed at then counts as failed; with
/// `resume`, items that failed before this run are run again. The function returns when all items
/// have ended. Throws CannotWrite if the journal cannot be written. No child process is left
/// running, even if an exception is thrown.
RunResult run_items(const std::vector<Item>& items, const RunSettings& settings,
                    const JournalRecord& earlier, Journal& journal, SharedList* shared,
                    const RunObserver& observer);

}  // namespace ibmfair::commands
