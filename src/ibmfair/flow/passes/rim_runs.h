// Open boundaries as curves: the runs of their vertices between corners.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/SparseCore>

#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// A boundary with fewer vertices has no room for a corner and a curve.
inline constexpr std::size_t least_rim_size = 8;

/// Successive vertices of an open boundary. Of an open run, the first and the last vertex are
/// corners, fixed vertices or ends of a boundary; a closed run has none, and its last vertex is
/// joined to its first.
struct RimRun {
  std::vector<Index> vertices;
  bool closed = false;
};

/// The runs of all open boundaries of the mesh at `X` (#V x 3), in the order of
/// Topology::boundary_loops. Left out are boundaries of fewer vertices than `least_rim_size`,
/// boundaries that end at an edge of more than two triangles, and runs without a vertex between
/// their ends. `fixed`: #V flags.
///
/// A vertex is a corner if the lines that fit the next vertices on both sides of it turn sharply,
/// and the lines that fit twice as many vertices hardly turn more: along a round curve, the turn
/// grows with the length, at a corner it does not. Fits over several vertices do not mind noise
/// and the zigzag of triangles.
std::vector<RimRun> rim_runs(const Points& X, const Topology& topology,
                             const std::vector<std::uint8_t>& fixed);

/// The matrix (n x n, symmetric) of the negative second differences along a curve of n vertices
/// beside which, unless it is closed, the values are zero.
Eigen::SparseMatrix<double> negative_second_differences(Index n, bool closed);

}  // namespace ibmfair
