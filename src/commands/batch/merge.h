// What became of a list that several processes have run, each a part of it.
#pragma once

#include <string>
#include <vector>

#include "commands/batch/item.h"
#include "commands/batch/journal.h"
#include "commands/batch/outcome.h"

namespace ibmfair::commands {

/// One outcome an item, as one run over the whole list would have it: ok where a run has made what
/// is there, failed where the last run of it did. What --resume would still run is not_run, with a
/// message that says why unless no run has begun it. `list_journal` is where the keys of the items
/// are seen from.
std::vector<Outcome> merged_outcomes(const std::vector<Item>& items, const JournalRecord& record,
                                     const std::string& list_journal);

}  // namespace ibmfair::commands
