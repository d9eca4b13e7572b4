// Rows of bytes of one size, between the ranks that have them in blocks and those that their
// vertices belong to. Collective.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "petsc_engine/blocks.h"

namespace ibmfair::petsc {

/// The rows of these numbers, which increase, out of the blocks: `block` has this rank's, of `row`
/// bytes each.
std::string fetch_rows(const Communicator& comm, const Blocks& blocks, std::string_view block,
                       std::int64_t row, const std::vector<Index>& numbers);

/// The reverse: this rank's block, out of the rows of these numbers that each rank has. Every row
/// of the blocks is named once.
std::string deliver_rows(const Communicator& comm, const Blocks& blocks, std::string_view rows,
                         std::int64_t row, const std::vector<Index>& numbers);

}  // namespace ibmfair::petsc
