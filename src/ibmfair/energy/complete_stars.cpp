#include "ibmfair/energy/complete_stars.h"

#include <algorithm>
#include <array>

#include "ibmfair/mesh/corners.h"

namespace ibmfair {
namespace {

bool is_complete(const Topology& topology, Index v) {
  const auto star = topology.stars[v];
  return topology.kind[v] == VertexKind::interior &&
         std::all_of(star.begin(), star.end(), [&](Index t) { return topology.usable[t] != 0; });
}

/// The two corners of triangle t other than v, in the triangle's order.
std::array<Index, 2> opposite_edge(const Topology& topology, Index t, Index v) {
  const int i = place_of(topology.F, t, v);
  return {topology.F(t, (i + 1) % 3), topology.F(t, (i + 2) % 3)};
}

}  // namespace

CompressedRows complete_stars(const Topology& topology, const std::vector<std::uint8_t>& active) {
  CompressedRows stars;
  stars.first.reserve(static_cast<std::size_t>(topology.vertex_count) + 1);
  stars.value.reserve(topology.stars.value.size() + stars.first.capacity());
  // For each vertex of the ring, the exclusive or a ^ b of the ring vertices before and after it.
  // Given either of them it yields the other, whatever the orientation of the triangles.
  std::vector<Index> link(static_cast<std::size_t>(topology.vertex_count), 0);
  for (Index v = 0; v < topology.vertex_count; ++v) {
    if (!is_complete(topology, v)) {
      continue;
    }
    const auto star = topology.stars[v];
    for (const Index t : star) {
      const auto [a, b] = opposite_edge(topology, t, v);
      link[a] ^= b;
      link[b] ^= a;
    }
    const std::size_t first = stars.value.size();
    stars.value.push_back(v);
    auto [previous, w] = opposite_edge(topology, star[0], v);
    for (std::size_t k = 0; k < star.size(); ++k) {
      stars.value.push_back(previous);
      const Index next = link[w] ^ previous;
      link[w] = 0;
      previous = w;
      w = next;
    }
    const bool matters =
        active.empty() || std::any_of(stars.value.begin() + static_cast<std::ptrdiff_t>(first),
                                      stars.value.end(), [&](Index u) { return active[u] != 0; });
    if (matters) {
      stars.first.push_back(static_cast<std::int64_t>(stars.value.size()));
    } else {
      stars.value.resize(first);
    }
  }
  return stars;
}

}  // namespace ibmfair
