// The symbolic factorization: the shape of L, from the graph of the matrix and an order.
#pragma once

#include <vector>

#include "ibmfair/base/rows.h"
#include "ibmfair/base/types.h"
#include "ibmfair/solve/supernodes.h"

namespace ibmfair {

struct SymbolicFactor {
  Supernodes nodes;
  double flops = 0;    ///< of one factorization
  double entries = 0;  ///< of L, without those that supernodes add for equal rows
};

/// For eliminating the nodes of the graph, whose edges are listed at both ends, in this order, or
/// another one that fills as much: children of a supernode are put next to it. Throws
/// FactorizationFailed or OutOfMemory.
SymbolicFactor symbolic_factor(const Rows& graph, const std::vector<Index>& order);

}  // namespace ibmfair
