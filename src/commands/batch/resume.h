// Whether what an earlier run has made is still what a run would make now.
#pragma once

#include <optional>
#include <string>

#include "commands/batch/item.h"
#include "commands/batch/journal.h"

namespace ibmfair::commands {

/// What the item is called in the journal: the file that it makes, as seen from the journal's
/// folder; its arguments where it makes none.
std::string journal_key(const Item& item, const std::string& journal_path);

/// All options that the result depends on, as one word.
std::string options_hash(const Item& item);

/// What the item would be made from now, before it is run: without hashes and outputs.
Finished begin_record(const Item& item);

/// Adds the hashes of the inputs. Returns false where one has changed meanwhile, so that nobody can
/// know what the result was made from.
bool add_hashes(const Item& item, Finished& record);

/// Whether the arguments and the program are as they were then.
bool same_options(const Item& item, const Finished& record);

/// Whether they and the inputs are, so that a run would end as that one did. An input whose stamp
/// differs is as it was if its bytes have the same hash.
bool same_task(const Item& item, const Finished& record);

/// What an earlier run found out, if the options, the program and every input and output are as
/// they were.
std::optional<Outcome> still_valid(const Item& item, const std::vector<Finished>& records);

}  // namespace ibmfair::commands
