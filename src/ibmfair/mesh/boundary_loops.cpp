#include "ibmfair/mesh/boundary_loops.h"

#include <algorithm>
#include <array>
#include <unordered_map>

#include "ibmfair/mesh/corners.h"

namespace ibmfair {
namespace {

Index corner_at(const Triangles& F, Index t, Index v) {
  return 3 * t + place_of(F, t, v);
}

/// A boundary edge in the direction of its triangle, between two fans.
struct BoundaryEdge {
  std::array<Index, 2> vertex;
  std::array<Index, 2> fan;
};

std::vector<BoundaryEdge> boundary_edges(const Topology& topology, const Fans& fans) {
  std::vector<BoundaryEdge> edges;
  for (Index e = 0; e < topology.E.rows(); ++e) {
    if (topology.edge_triangles[e].size() == 1) {
      const Index t = topology.edge_triangles[e][0];
      Index a = topology.E(e, 0), b = topology.E(e, 1);
      if (!runs_along(topology.F, t, a, b)) {
        std::swap(a, b);
      }
      edges.push_back({{a, b}, {fans.at(topology, t, a), fans.at(topology, t, b)}});
    }
  }
  return edges;
}

/// The one or two boundary edges at each fan; the second is -1 where there is only one.
using EdgesAtFan = std::unordered_map<Index, std::array<Index, 2>>;

EdgesAtFan edges_at_fans(const std::vector<BoundaryEdge>& edges) {
  EdgesAtFan at_fan;
  for (Index i = 0; i < static_cast<Index>(edges.size()); ++i) {
    for (const Index fan : edges[i].fan) {
      auto& pair = at_fan.try_emplace(fan, std::array<Index, 2>{-1, -1}).first->second;
      pair[pair[0] < 0 ? 0 : 1] = i;
    }
  }
  return at_fan;
}

/// The loop starts at its smallest vertex; whether it is simple shows in the sorted vertices.
void normalise(BoundaryLoop& loop) {
  auto& v = loop.vertices;
  if (loop.closed) {
    std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
  }
  std::vector<Index> sorted = v;
  std::sort(sorted.begin(), sorted.end());
  loop.simple = std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
}

}  // namespace

Fans::Fans(const Topology& topology) {
  UnionFind sets(static_cast<Index>(3 * topology.F.rows()));
  for (Index e = 0; e < topology.E.rows(); ++e) {
    if (const auto t = topology.edge_triangles[e]; t.size() == 2) {
      for (const Index v : {topology.E(e, 0), topology.E(e, 1)}) {
        sets.unite(corner_at(topology.F, t[0], v), corner_at(topology.F, t[1], v));
      }
    }
  }
  fan_.resize(static_cast<std::size_t>(3 * topology.F.rows()));
  for (Index c = 0; c < static_cast<Index>(fan_.size()); ++c) {
    fan_[c] = sets.find(c);
  }
}

Index Fans::at(const Topology& topology, Index t, Index v) const {
  return fan_[corner_at(topology.F, t, v)];
}

Index Fans::count(const Topology& topology, Index v) const {
  // A fan is named by its smallest corner, so every fan is met exactly once under its own name.
  Index fans = 0;
  for (const Index t : topology.stars[v]) {
    const Index corner = corner_at(topology.F, t, v);
    fans += fan_[corner] == corner ? 1 : 0;
  }
  return fans;
}

std::vector<BoundaryLoop> find_boundary_loops(const Topology& topology, const Fans& fans) {
  const std::vector<BoundaryEdge> edges = boundary_edges(topology, fans);
  const EdgesAtFan at_fan = edges_at_fans(edges);
  std::vector<std::uint8_t> walked(edges.size(), 0);

  // Walks from edge `start`, leaving it at its end `side`; ends do not depend on orientation, so
  // the loop of a Moebius strip closes like any other.
  const auto walk = [&](Index start, int side) {
    BoundaryLoop loop;
    Index i = start;
    loop.vertices.push_back(edges[i].vertex[1 - side]);
    while (true) {
      walked[i] = 1;
      const Index fan = edges[i].fan[side];
      const auto& pair = at_fan.at(fan);
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
  const auto ends_at = [&](Index i, int side) { return at_fan.at(edges[i].fan[side])[1] < 0; };
  for (const bool chains : {true, false}) {  // what is left after the open chains are cycles
    for (Index i = 0; i < static_cast<Index>(edges.size()); ++i) {
      if (!walked[i] && (!chains || ends_at(i, 0) || ends_at(i, 1))) {
        loops.push_back(walk(i, ends_at(i, 0) || !ends_at(i, 1) ? 1 : 0));
        normalise(loops.back());
      }
    }
  }
  std::sort(loops.begin(), loops.end(), [](const BoundaryLoop& a, const BoundaryLoop& b) {
    return *std::min_element(a.vertices.begin(), a.vertices.end()) <
           *std::min_element(b.vertices.begin(), b.vertices.end());
  });
  return loops;
}

}  // namespace ibmfair
