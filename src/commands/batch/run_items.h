// Runs the items of a list, several at a time, each in a process of its own.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "commands/batch/item.h"
#include "commands/batch/journal.h"
#include "commands/batch/outcome.h"

namespace ibmfair::commands {

struct RunSettings {
  int jobs = 1;     ///< at a time, at least 1
  int threads = 1;  ///< of every item that does not say
  bool fail_fast = false;
  bool resume = false;  ///< what `earlier` runs have done is skipped or replaced
  bool overwrite = false;
  std::string list_journal;  ///< of the whole list, from where the keys of items are seen
};

/// Called as each item ends, in the order in which they do, with its place in the list.
using OutcomeObserver = std::function<void(std::size_t index, const Outcome& outcome)>;

struct RunResult {
  std::vector<Outcome> outcomes;  ///< one an item
  int signal_number = 0;          ///< that stopped the batch; 0: none
};

/// Throws CannotWrite where the journal cannot be written. Whatever happens, no process is left
/// behind.
RunResult run_items(const std::vector<Item>& items, const RunSettings& settings,
                    const JournalRecord& earlier, Journal& journal, const OutcomeObserver& observe);

/// The folders that the item writes to.
std::set<std::string> output_folders(const Item& item);

}  // namespace ibmfair::commands
