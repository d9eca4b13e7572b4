// Predicts the vertices of open boundaries from the triangles inside: beside a boundary there is no
// ring of neighbours whose mean could predict them.
#pragma once

#include <Eigen/SparseCore>

#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// The matrix (#V x #V) that predicts the boundary vertices of a mesh; all other rows are empty.
/// Across the edge that is opposite to the vertex in one of its triangles lies another triangle,
/// and the point that completes this one to a parallelogram is a prediction; a row is the mean of
/// its vertex's predictions. So rows add up to 1, affine images of regular triangulations of a
/// plane are predicted exactly, and neither corners nor teeth of a rim matter. The row of a vertex
/// without such an edge is empty, too.
Eigen::SparseMatrix<double, Eigen::RowMajor> rim_extrapolation(const Topology& topology);

/// The unit normal of the surface beside vertex v of the mesh at X (#V x 3): of the triangles that
/// have a neighbour of v as a corner, but not v. Zero if they have no area in sum.
Vec3 normal_beside(const Points& X, const Topology& topology, Index v);

}  // namespace ibmfair
