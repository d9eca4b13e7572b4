#include "ibmfair/mesh/boundary_loops.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "ibmfair/mesh/corners.h"
#include "ibmfair/mesh/fans.h"
#include "ibmfair/mesh/select.h"

namespace ibmfair {
namespace {

/// A boundary edge, directed as in its triangle, with the fans at its two ends.
struct BoundaryEdge {
  std::array<Index, 2> vertex;
  std::array<Index, 2> fan;
};

std::vector<BoundaryEdge> boundary_edges(const Topology& topology, const std::vector<Index>& edges,
                                         const Fans& fans) {
  std::vector<BoundaryEdge> result;
  result.reserve(edges.size());
  for (const Index e : edges) {
    const Index t = topology.edge_triangles[e][0];
    Index a = topology.E(e, 0), b = topology.E(e, 1);
    if (!runs_along(topology.F, t, a, b)) {
      std::swap(a, b);
    }
    result.push_back({{a, b}, {fans.at(topology, t, a), fans.at(topology, t, b)}});
  }
  return result;
}

/// The one or two boundary edges of each fan; -1 if there are fewer.
using EdgesAtFan = std::vector<std::array<Index, 2>>;

EdgesAtFan edges_at_fans(const std::vector<BoundaryEdge>& edges, Index fan_bound) {
  EdgesAtFan at_fan(static_cast<std::size_t>(fan_bound), {-1, -1});
  for (Index i = 0; i < static_cast<Index>(edges.size()); ++i) {
    for (const Index fan : edges[i].fan) {
      auto& pair = at_fan[fan];
      pair[pair[0] < 0 ? 0 : 1] = i;
    }
  }
  return at_fan;
}

/// Makes a closed loop start at its smallest vertex, and finds out whether the loop is simple.
void normalise(BoundaryLoop& loop) {
  auto& v = loop.vertices;
  if (loop.closed) {
    std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
  }
  std::vector<Index> sorted = v;
  std::sort(sorted.begin(), sorted.end());
  loop.simple = std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
}

std::vector<BoundaryLoop> ordered_by_smallest_vertex(std::vector<BoundaryLoop> loops) {
  struct Key {
    Index smallest;
    std::size_t loop;
  };
  std::vector<Key> keys;
  keys.reserve(loops.size());
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const auto& v = loops[i].vertices;
    keys.push_back({*std::min_element(v.begin(), v.end()), i});
  }
  std::sort(keys.begin(), keys.end(),
            [](const Key& a, const Key& b) { return a.smallest < b.smallest; });
  std::vector<BoundaryLoop> ordered;
  ordered.reserve(loops.size());
  for (const Key& key : keys) {
    ordered.push_back(std::move(loops[key.loop]));
  }
  return ordered;
}

std::vector<BoundaryLoop> walk_loops(const std::vector<BoundaryEdge>& edges,
                                     const EdgesAtFan& at_fan) {
  std::vector<std::uint8_t> walked(edges.size(), 0);

  // Walks along the boundary from edge `start`, first to its end `side` (0 or 1). At each further
  // edge, the side is found from the shared fan and not from the orientation, so the loop of a
  // Moebius strip closes like any other.
  const auto walk = [&](Index start, int side) {
    BoundaryLoop loop;
    Index i = start;
    loop.vertices.push_back(edges[i].vertex[1 - side]);
    while (true) {
      walked[i] = 1;
      const Index fan = edges[i].fan[side];
      const auto& pair = at_fan[fan];
      const Index next = pair[0] == i ? pair[1] : pair[0];
      if (next == start) {
        break;
      }
      loop.vertices.push_back(edges[i].vertex[side]);
      if (next < 0) {
        loop.closed = false;
        break;
      }
      side = edges[next].fan[0] == fan ? 1 : 0;
      i = next;
    }
    return loop;
  };

  std::vector<BoundaryLoop> loops;
  const auto ends_at = [&](Index i, int side) { return at_fan[edges[i].fan[side]][1] < 0; };
  for (const bool chains : {true, false}) {  // open chains first; the remaining edges form cycles
    for (Index i = 0; i < static_cast<Index>(edges.size()); ++i) {
      if (!walked[i] && (!chains || ends_at(i, 0) || ends_at(i, 1))) {
        loops.push_back(walk(i, ends_at(i, 0) || !ends_at(i, 1) ? 1 : 0));
        normalise(loops.back());
      }
    }
  }
  return loops;
}

}  // namespace

std::vector<BoundaryLoop> find_boundary_loops(const Topology& topology) {
  const std::vector<Index> single = indices_where(
      topology.E.rows(), [&](Index e) { return topology.edge_triangles[e].size() == 1; });
  if (single.empty()) {
    return {};
  }
  const Fans fans(topology);
  const std::vector<BoundaryEdge> edges = boundary_edges(topology, single, fans);
  return ordered_by_smallest_vertex(walk_loops(edges, edges_at_fans(edges, fans.bound())));
}

}  // namespace ibmfair
