// In which order the unknowns are eliminated: what decides how large the factor becomes.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/energy/hessian.h"

namespace ibmfair {

/// Approximate minimum degree is quick; nested dissection (by METIS) is slow, and gives smaller
/// factors for large matrices of compact surfaces. Automatic chooses by what minimum degree leaves.
enum class Ordering : std::uint8_t { automatic, amd, metis };

/// Nested dissection of the graph of `J`: the unknowns in order of elimination. METIS sees pairs of
/// unknowns that depend on each other most, and so a graph with a third of the edges.
/// Throws OutOfMemory or FactorizationFailed.
std::vector<Index> nested_dissection(const SymmetricMatrix& J);

}  // namespace ibmfair
