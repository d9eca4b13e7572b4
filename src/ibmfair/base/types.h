// The few types that every room shares.
#pragma once

#include <cstdint>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace ibmfair {

/// A vertex, face, edge or hinge number. Meshes have fewer than 2^31 of each; anything that can
/// exceed that (entries of a sparse matrix, bytes of a file) is std::int64_t.
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
