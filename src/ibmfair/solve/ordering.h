// Elimination orders for the unknowns. The order determines the fill-in and so the size of the
// factor.
#pragma once

#include <string_view>
#include <vector>

#include "ibmfair/base/compressed_rows.h"
#include "ibmfair/base/symmetric_matrix.h"
#include "ibmfair/base/types.h"

namespace ibmfair {

/// The undirected graph of J: for each unknown its neighbours, without the unknown itself.
CompressedRows graph_of(const SymmetricMatrix& J);

/// The nodes of the graph in an elimination order, by approximate minimum degree [P. Amestoy, T.
/// Davis, I. Duff, "An approximate minimum degree ordering algorithm", SIAM J. Matrix Anal. Appl.
/// 17 (1996)]. Throws OutOfMemory.
std::vector<Index> minimum_degree(const CompressedRows& graph);

/// An elimination order by nested dissection [A. George, "Nested dissection of a regular finite
/// element mesh", SIAM J. Numer. Anal. 10 (1973)], for the graph of a surface with the positions
/// `X` (#nodes x 3) of its nodes. A separator (solve/separator.h) comes after the two sides that it
/// separates. Each side is dissected recursively; sides that are small or have no good separator
/// are ordered by minimum degree. The order is identical for any number of threads. Throws
/// OutOfMemory.
std::vector<Index> nested_dissection(const CompressedRows& graph, const Points& X);

struct EliminationOrder {
  std::string_view method;     ///< "minimum degree" or "nested dissection"
  std::vector<Index> unknown;  ///< the nodes of the graph, from the first eliminated to the last
};

/// The order that takes the least time in total: nested dissection, which gives less fill-in and
/// runs on all threads, for large graphs, and minimum degree for small ones. Throws OutOfMemory.
EliminationOrder elimination_order(const CompressedRows& graph, const Points& X);

}  // namespace ibmfair
