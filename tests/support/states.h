// Meshes in the form that the numerics use: vertex positions and the connectivity of triangles.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "ibmfair/mesh/geometry.h"
#include "ibmfair/mesh/mesh.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair::test {

/// A mesh cut into triangles, with its connectivity.
struct State {
  Points X;
  Topology topology;

  explicit State(const Mesh& mesh) : X(mesh.X), topology(build_topology(X, triangulate(mesh).F)) {}
};

/// The mesh with its faces cut into triangles. If a square can be cut either way, the order of its
/// corners decides.
inline Mesh in_triangles(const Mesh& mesh) {
  return mesh_from_triangles(mesh.X, triangulate(mesh).F);
}

/// A flag for each vertex (#V): whether it is within so many rings of the given vertices.
inline std::vector<std::uint8_t> around(const Topology& topology,
                                        const std::vector<Index>& vertices, int rings) {
  std::vector<std::uint8_t> flags(static_cast<std::size_t>(topology.vertex_count), 0);
  for (const Index v : vertices) {
    flags[v] = 1;
  }
  for (int i = 0; i < rings; ++i) {
    flags = grow_one_ring(topology, flags);
  }
  return flags;
}

/// A fixed random direction for every vertex, #V x 3, entries in [-1, 1].
inline Points random_directions(Eigen::Index vertices, unsigned seed = 1) {
  std::mt19937 generator(seed);
  Points D(vertices, 3);
  for (double& entry : D.reshaped<Eigen::RowMajor>()) {
    entry = 2.0 * generator() / static_cast<double>(std::mt19937::max()) - 1.0;
  }
  return D;
}

/// The vertex positions with every coordinate moved at random by up to `amount` mean edge lengths.
inline Points shaken(const State& state, double amount, unsigned seed = 2) {
  return state.X + amount * mean_edge_length(state.X, state.topology.E) *
                       random_directions(state.X.rows(), seed);
}

/// The vertex positions with one corner of a triangle moved. The distance of this corner from the
/// opposite side becomes `height` times the length of that side; the triangle's smallest angle is
/// about twice `height`.
inline Points with_needle(const State& state, Index triangle, double height) {
  Points X = state.X;
  const auto corners = state.topology.F.row(triangle);
  const Vec3 a = X.row(corners[0]), b = X.row(corners[1]), c = X.row(corners[2]);
  const Vec3 foot = (b + c) / 2;
  X.row(corners[0]) = foot + height * (c - b).norm() * (a - foot).normalized();
  return X;
}

}  // namespace ibmfair::test
