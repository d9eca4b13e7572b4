#include "ibmfair/io/weld.h"

#include <array>
#include <bit>

namespace ibmfair {
namespace {

std::size_t hash_position(const Points& X, Eigen::Index v) {
  std::uint64_t hash = 0;
  for (int c = 0; c < 3; ++c) {
    // Adding zero turns -0 into +0. The multiplier is that of a 64-bit linear congruential
    // generator; the shift mixes the high bits into the low bits, which select the slot of the
    // table.
    hash = (hash ^ std::bit_cast<std::uint64_t>(X(v, c) + 0.0)) * 6364136223846793005U;
    hash ^= hash >> 32;
  }
  return static_cast<std::size_t>(hash);
}

}  // namespace

Weld find_coincident_vertices(const Points& X) {
  const auto count = static_cast<std::size_t>(X.rows());
  const std::size_t size = std::bit_ceil(2 * count + 1);
  std::vector<Index> table(size, -1);  // numbers of new vertices
  Weld weld;
  weld.vertex.resize(count);
  for (std::size_t v = 0; v < count; ++v) {
    const auto row = static_cast<Eigen::Index>(v);
    std::size_t slot = hash_position(X, row) & (size - 1);
    while (table[slot] >= 0 && X.row(weld.first[table[slot]]) != X.row(row)) {
      slot = (slot + 1) & (size - 1);
    }
    if (table[slot] < 0) {
      table[slot] = static_cast<Index>(weld.first.size());
      weld.first.push_back(static_cast<Index>(v));
    }
    weld.vertex[v] = table[slot];
  }
  return weld;
}

void apply(const Weld& weld, Mesh& mesh) {
  mesh.X = mesh.X(weld.first, Eigen::all).eval();
  for (Index& v : mesh.faces.corner)
    v = weld.vertex[v];
}

}  // namespace ibmfair
