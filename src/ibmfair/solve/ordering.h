// In which order the unknowns are eliminated: what decides how large the factor becomes.
#pragma once

#include <vector>

#include "ibmfair/base/rows.h"
#include "ibmfair/base/types.h"
#include "ibmfair/energy/hessian.h"

namespace ibmfair {

/// The undirected graph of J: the unknowns that each one is tied to, without itself.
Rows graph_of(const SymmetricMatrix& J);

/// The nodes of the graph in order of elimination, by approximate minimum degree [P. Amestoy,
/// T. Davis, I. Duff, "An approximate minimum degree ordering algorithm", SIAM J. Matrix Anal.
/// Appl. 17 (1996)]. Throws OutOfMemory.
std::vector<Index> minimum_degree(const Rows& graph);

/// An elimination order by nested dissection [A. George, "Nested dissection of a regular finite
/// element mesh", SIAM J. Numer. Anal. 10 (1973)] of a surface: a separator (solve/separator.h)
/// comes after the sides that it leaves, which are dissected likewise until they are left to
/// minimum degree. `X`
/// (#nodes x 3) is where the nodes lie. The same for any number of threads. Throws OutOfMemory.
std::vector<Index> nested_dissection(const Rows& graph, const Points& X);

}  // namespace ibmfair
