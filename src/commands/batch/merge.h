// The outcomes of a list of which several processes have each run a part.
#pragma once

#include <string>
#include <vector>

#include "commands/batch/item.h"
#include "commands/batch/journal.h"
#include "commands/batch/outcome.h"

namespace ibmfair::commands {

/// Returns one outcome per item, as if one run had processed the whole list: ok if the existing
/// outputs are those of a finished run, failed if the last run of the item failed, and not_run for
/// every item that --resume would still run. The message of a not_run outcome gives the reason; it
/// is empty if no run has started the item. Keys of items are relative to the folder of
/// `list_journal`.
std::vector<Outcome> merged_outcomes(const std::vector<Item>& items, const JournalRecord& record,
                                     const std::string& list_journal);

}  // namespace ibmfair::commands
