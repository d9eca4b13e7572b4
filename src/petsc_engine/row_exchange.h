// Exchange of rows of bytes, all of one size, between the ranks whose blocks hold the rows and the
// ranks that own the vertices of the rows. Collective.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "petsc_engine/blocks.h"

namespace ibmfair::petsc {

/// Fetches the rows with the given numbers, which must increase, from the blocks of all ranks.
/// `block` holds the rows of this rank's block; each row has `row` bytes.
std::string fetch_rows(const Communicator& comm, const Blocks& blocks, std::string_view block,
                       std::int64_t row, const std::vector<Index>& numbers);

/// The reverse of fetch_rows(): `rows` are this rank's rows with the given increasing numbers;
/// returns this rank's block. Every row of the blocks must be named exactly once over all ranks.
std::string deliver_rows(const Communicator& comm, const Blocks& blocks, std::string_view rows,
                         std::int64_t row, const std::vector<Index>& numbers);

}  // namespace ibmfair::petsc
