// Items that would get in each other's way: they run in no particular order, and are run again when
// a batch is resumed.
#pragma once

#include <vector>

#include "commands/batch/item.h"

namespace ibmfair::commands {

/// The items without those whose input a glob found (`found_by_glob`, one an item) although it is
/// what another of them writes.
std::vector<Item> without_own_outputs(std::vector<Item> items,
                                      const std::vector<bool>& found_by_glob);

/// Throws BadFile where a file that an item reads is not there.
void require_inputs(const std::vector<Item>& items);

/// Throws BadOption where two items write one file, or one writes what it or another reads.
void reject_conflicts(const std::vector<Item>& items);

}  // namespace ibmfair::commands
