// Runs the items of a list, several at a time, each in a process of its own.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "commands/batch/item.h"
#include "commands/batch/journal.h"
#include "commands/batch/outcome.h"

namespace ibmfair::commands {

struct RunSettings {
  int jobs = 1;     ///< number of items to run at the same time, at least 1
  int threads = 1;  ///< threads of every item that does not set --threads
  bool fail_fast = false;
  bool resume = false;  ///< skip items that earlier runs have finished, redo the others
  bool overwrite = false;
  std::string list_journal;  ///< path; the keys of items are relative to its folder
};

/// Called at the end of each item, in the order in which the items end, with the index of the item
/// in the list.
using OutcomeObserver = std::function<void(std::size_t index, const Outcome& outcome)>;

struct RunResult {
  std::vector<Outcome> outcomes;  ///< one per item
  int signal_number = 0;          ///< signal that stopped the batch; 0: none
};

/// Runs the items, and returns when all of them have ended. Throws CannotWrite if the journal
/// cannot be written. No child process is left running, even if an exception is thrown.
RunResult run_items(const std::vector<Item>& items, const RunSettings& settings,
                    const JournalRecord& earlier, Journal& journal, const OutcomeObserver& observe);

}  // namespace ibmfair::commands
