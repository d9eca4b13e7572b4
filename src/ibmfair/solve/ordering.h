// In which order the unknowns are eliminated: what decides how large the factor becomes.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/energy/hessian.h"

namespace ibmfair {

/// Approximate minimum degree is quick, and best for small matrices; nested dissection (by METIS)
/// gives smaller factors for large ones. Automatic chooses by the number of unknowns.
enum class Ordering : std::uint8_t { automatic, amd, metis };

/// Nested dissection of the graph of `J`: the unknowns in order of elimination. METIS sees groups
/// of four unknowns that depend on each other most, and so a graph with an eighth of the edges.
/// Throws OutOfMemory or FactorizationFailed.
std::vector<Index> nested_dissection(const SymmetricMatrix& J);

}  // namespace ibmfair
