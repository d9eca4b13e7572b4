// Meshes whose vertices and triangles stand in another order.
#pragma once

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include "ibmfair/shapes/grids.h"

namespace ibmfair::test {

/// The numbers 0 .. size - 1 in an order that `seed` fixes on every machine.
inline std::vector<Index> permutation(Eigen::Index size, unsigned seed) {
  std::vector<Index> order(static_cast<std::size_t>(size));
  std::iota(order.begin(), order.end(), 0);
  std::mt19937 generator(seed);
  for (std::size_t i = order.size(); i > 1; --i) {
    std::swap(order[i - 1], order[generator() % i]);
  }
  return order;
}

/// Vertex v becomes vertex number[v]; triangles, too, stand in another order.
inline TriangleMesh renumbered(const TriangleMesh& mesh, const std::vector<Index>& number) {
  TriangleMesh other = mesh;
  other.X(number, Eigen::all) = mesh.X;
  other.F = mesh.F(permutation(mesh.F.rows(), 5), Eigen::all);
  for (Index& corner : other.F.reshaped()) {
    corner = number[corner];
  }
  return other;
}

}  // namespace ibmfair::test
