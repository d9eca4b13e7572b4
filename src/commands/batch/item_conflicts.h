// Detects conflicts between items. Items run in no particular order and may be run again when a
// batch is resumed, so no item may write a file that another item reads or writes.
#pragma once

#include <vector>

#include "commands/batch/item.h"

namespace ibmfair::commands {

/// Removes the items whose input was found by a glob (`found_by_glob`, one value per item) but is a
/// file that another item writes.
std::vector<Item> without_own_outputs(std::vector<Item> items,
                                      const std::vector<bool>& found_by_glob);

/// Throws BadFile if a file that an item reads does not exist.
void require_inputs(const std::vector<Item>& items);

/// Throws BadOption if two items write the same file, or if an item writes a file that it or
/// another item reads.
void reject_conflicts(const std::vector<Item>& items);

}  // namespace ibmfair::commands
