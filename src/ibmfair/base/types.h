// The few types that all parts of the library share.
#pragma once

#include <cstdint>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace ibmfair {

/// The number of a vertex, face, edge or hinge. A mesh has fewer than 2^31 of each; quantities that
/// can exceed this (entries of a sparse matrix, bytes of a file) are std::int64_t.
using Index = std::int32_t;

/// Vertex positions, #V x 3, one vertex a row, in the mesh's own length unit.
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Triangles, #F x 3, each row three vertex numbers.
using Triangles = Eigen::Matrix<Index, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// One position or direction.
using Vec3 = Eigen::Vector3d;

/// One value per vertex, #V.
using PerVertex = Eigen::VectorXd;

}  // namespace ibmfair
