// The symbolic factorization: the structure of L, from the graph of the matrix and an elimination
// order.
#pragma once

#include <vector>

#include "ibmfair/base/compressed_rows.h"
#include "ibmfair/base/types.h"
#include "ibmfair/solve/supernodes.h"

namespace ibmfair {

struct SymbolicFactor {
  Supernodes nodes;
  double flops = 0;    ///< floating-point operations per factorization
  double entries = 0;  ///< of L, not counting zeros added by merging columns into supernodes
};

/// The structure of L for the given elimination order of the graph, which lists each edge at both
/// ends. The order is first replaced by a postorder of the elimination tree, an equivalent order
/// with the same fill-in that puts the children of a supernode next to it. Throws
/// FactorizationFailed or OutOfMemory.
SymbolicFactor symbolic_factor(const CompressedRows& graph, const std::vector<Index>& order);

}  // namespace ibmfair
