// Decides whether the result of an earlier run is still valid: whether a new run would give the
// same result.
#pragma once

#include <optional>
#include <string>

#include "commands/batch/item.h"
#include "commands/batch/journal.h"

namespace ibmfair::commands {

/// The key of the item in the journal: the path of its output relative to the journal's folder, or
/// the command and a hash of its options if the item writes no file.
std::string journal_key(const Item& item, const std::string& journal_path);

/// A hash of the whole job except --threads and --overwrite, which do not change the result.
std::string options_hash(const Item& item);

/// The record of the item before it runs: options, program version and the stamps of the inputs,
/// without hashes and outputs.
Finished begin_record(const Item& item);

/// Adds the hashes of the inputs to the record. Returns false if an input has changed since
/// begin_record(), because it is then unknown which content the result was made from.
bool add_hashes(const Item& item, Finished& record);

/// Whether options, program version and inputs equal those in the record, so that a new run would
/// end in the same way. An input whose stamp differs is unchanged if its bytes have the same hash.
bool same_task(const Item& item, const Finished& record);

/// The outcome of an earlier run, with status `skipped`, if the options, the program's version and
/// all inputs and outputs are unchanged; else nothing.
std::optional<Outcome> still_valid(const Item& item, const std::vector<Finished>& records);

}  // namespace ibmfair::commands
