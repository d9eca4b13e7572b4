// Meshes whose vertices and triangles are in another order.
#pragma once

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include "ibmfair/shapes/grids.h"

namespace ibmfair::test {

/// The numbers 0 .. size - 1 in a random order. The order depends on `seed` only and is the same on
/// every machine.
inline std::vector<Index> permutation(Eigen::Index size, unsigned seed) {
  std::vector<Index> order(static_cast<std::size_t>(size));
  std::iota(order.begin(), order.end(), 0);
  std::mt19937 generator(seed);
  for (std::size_t i = order.size(); i > 1; --i) {
    std::swap(order[i - 1], order[generator() % i]);
  }
  return order;
}

/// The mesh with vertex v renumbered to number[v], and with its triangles in another order, too.
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
