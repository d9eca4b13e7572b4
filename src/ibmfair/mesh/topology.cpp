#include "ibmfair/mesh/topology.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "ibmfair/mesh/boundary_loops.h"
#include "ibmfair/mesh/corners.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/mesh/orientation.h"
#include "ibmfair/mesh/union_find.h"

namespace ibmfair {
namespace {

bool repeats_corner(const Triangles& F, Index t) {
  return F(t, 0) == F(t, 1) || F(t, 1) == F(t, 2) || F(t, 2) == F(t, 0);
}

/// Lists items by key: a counting sort, so that building stays linear in the size of the mesh.
class RowsBuilder {
 public:
  explicit RowsBuilder(Index rows) { rows_.first.assign(static_cast<std::size_t>(rows) + 1, 0); }
  void count(Index row) { ++rows_.first[static_cast<std::size_t>(row) + 1]; }
  void reserve() {
    std::partial_sum(rows_.first.begin(), rows_.first.end(), rows_.first.begin());
    rows_.value.resize(static_cast<std::size_t>(rows_.first.back()));
    next_.assign(rows_.first.begin(), rows_.first.end() - 1);
  }
  void put(Index row, Index value) { rows_.value[next_[row]++] = value; }
  Rows take() { return std::move(rows_); }

 private:
  Rows rows_;
  std::vector<std::int64_t> next_;
};

Rows vertex_stars(Index vertex_count, const Triangles& F) {
  RowsBuilder builder(vertex_count);
  const auto each = [&](auto&& act) {
    for (Index t = 0; t < F.rows(); ++t) {
      for (int i = 0; i < 3 && !repeats_corner(F, t); ++i) {
        act(F(t, i), t);
      }
    }
  };
  each([&](Index v, Index) { builder.count(v); });
  builder.reserve();
  each([&](Index v, Index t) { builder.put(v, t); });
  return builder.take();
}

/// Finds the edges by their smaller vertex: every star is short, so sorting each is cheap.
void find_edges(Topology& topology) {
  struct HalfEdge {
    Index other, triangle;
    auto operator<=>(const HalfEdge&) const = default;
  };
  std::vector<HalfEdge> around;
  std::vector<std::array<Index, 2>> edges;
  Rows& triangles = topology.edge_triangles;
  for (Index v = 0; v < topology.vertex_count; ++v) {
    around.clear();
    for (const Index t : topology.stars[v]) {
      for (int i = 0; i < 3; ++i) {
        if (topology.F(t, i) > v) {
          around.push_back({topology.F(t, i), t});
        }
      }
    }
    std::sort(around.begin(), around.end());
    for (std::size_t i = 0; i < around.size(); ++i) {
      if (i == 0 || around[i].other != around[i - 1].other) {
        edges.push_back({v, around[i].other});
        triangles.first.push_back(triangles.first.back());
      }
      triangles.value.push_back(around[i].triangle);
      ++triangles.first.back();
    }
  }
  topology.E.resize(static_cast<Eigen::Index>(edges.size()), 2);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    topology.E.row(static_cast<Eigen::Index>(e)) << edges[e][0], edges[e][1];
  }
}

std::array<Index, 3> sorted_corners(const Triangles& F, Index t) {
  std::array<Index, 3> key{F(t, 0), F(t, 1), F(t, 2)};
  std::sort(key.begin(), key.end());
  return key;
}

/// Triangles over the same vertices meet at all their edges, so looking at one star is enough.
std::vector<Index> find_duplicates(const Topology& topology) {
  std::vector<Index> duplicates;
  std::vector<std::pair<std::array<Index, 3>, Index>> keys;
  for (Index v = 0; v < topology.vertex_count; ++v) {
    keys.clear();
    for (const Index t : topology.stars[v]) {
      if (const auto key = sorted_corners(topology.F, t); key[0] == v) {
        keys.emplace_back(key, t);
      }
    }
    std::sort(keys.begin(), keys.end());
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const bool as_before = i > 0 && keys[i].first == keys[i - 1].first;
      const bool as_after = i + 1 < keys.size() && keys[i].first == keys[i + 1].first;
      if (as_before || as_after) {
        duplicates.push_back(keys[i].second);
      }
    }
  }
  std::sort(duplicates.begin(), duplicates.end());
  return duplicates;
}

void find_hinges(Topology& topology) {
  std::vector<Index> hinge_edges;
  for (Index e = 0; e < topology.E.rows(); ++e) {
    const auto t = topology.edge_triangles[e];
    if (t.size() == 2 && topology.usable[t[0]] && topology.usable[t[1]]) {
      hinge_edges.push_back(e);
    }
  }
  const auto count = static_cast<Eigen::Index>(hinge_edges.size());
  topology.H.resize(count, 4);
  topology.hinge_triangles.resize(count, 2);
  for (Eigen::Index h = 0; h < count; ++h) {
    const Index e = hinge_edges[h];
    Index a = topology.E(e, 0), b = topology.E(e, 1);
    Index t0 = topology.edge_triangles[e][0], t1 = topology.edge_triangles[e][1];
    if (!runs_along(topology.F, t0, a, b)) {
      if (runs_along(topology.F, t1, a, b)) {
        std::swap(t0, t1);
      } else {  // the two disagree: the edge of a non-orientable cut
        std::swap(a, b);
      }
    }
    topology.H.row(h) << a, b, opposite_vertex(topology.F, t0, a, b),
        opposite_vertex(topology.F, t1, a, b);
    topology.hinge_triangles.row(h) << t0, t1;
  }
}

void find_components(Topology& topology) {
  UnionFind sets(topology.vertex_count);
  for (const auto edge : topology.E.rowwise()) {
    sets.unite(edge[0], edge[1]);
  }
  std::vector<Index> number(static_cast<std::size_t>(topology.vertex_count), -1);
  topology.component.assign(static_cast<std::size_t>(topology.vertex_count), -1);
  for (Index v = 0; v < topology.vertex_count; ++v) {
    if (!topology.stars[v].empty()) {
      Index& n = number[sets.find(v)];
      n = n < 0 ? topology.component_count++ : n;
      topology.component[v] = n;
    }
  }
}

/// Boundary and irregular vertices. A fan is a set of corners at one vertex that are joined across
/// edges of exactly two triangles; a surface has one fan at each vertex.
void classify_vertices(Topology& topology, const Fans& fans) {
  topology.kind.assign(static_cast<std::size_t>(topology.vertex_count), VertexKind::interior);
  for (Index v = 0; v < topology.vertex_count; ++v) {
    if (topology.stars[v].empty()) {
      topology.kind[v] = VertexKind::isolated;
    }
  }
  for (Index e = 0; e < topology.E.rows(); ++e) {
    const auto count = topology.edge_triangles[e].size();
    for (const Index v : {topology.E(e, 0), topology.E(e, 1)}) {
      if (count == 1 && topology.kind[v] == VertexKind::interior) {
        topology.kind[v] = VertexKind::boundary;
      } else if (count > 2) {
        topology.kind[v] = VertexKind::irregular;
      }
    }
    if (count > 2) {
      topology.defects.non_manifold_edges.push_back(e);
    }
  }
  for (Index v = 0; v < topology.vertex_count; ++v) {
    if (topology.kind[v] != VertexKind::irregular && fans.count(topology, v) > 1) {
      topology.kind[v] = VertexKind::irregular;
      topology.defects.bow_tie_vertices.push_back(v);
    }
  }
}

void mark_defective_vertices(Topology& topology) {
  const Defects& defects = topology.defects;
  topology.defective.assign(static_cast<std::size_t>(topology.vertex_count), 0);
  for (const auto* triangles : {&defects.repeated_corner, &defects.zero_area, &defects.duplicate}) {
    for (const Index t : *triangles) {
      for (int i = 0; i < 3; ++i) {
        topology.defective[topology.F(t, i)] = 1;
      }
    }
  }
  for (const Index e : defects.non_manifold_edges) {
    topology.defective[topology.E(e, 0)] = topology.defective[topology.E(e, 1)] = 1;
  }
  for (const Index v : defects.bow_tie_vertices) {
    topology.defective[v] = 1;
  }
}

}  // namespace

bool Defects::empty() const {
  return count() == 0;
}

std::int64_t Defects::count() const {
  return static_cast<std::int64_t>(repeated_corner.size() + zero_area.size() + duplicate.size() +
                                   non_manifold_edges.size() + bow_tie_vertices.size());
}

std::int64_t Topology::euler_characteristic() const {
  const auto used = std::count_if(kind.begin(), kind.end(),
                                  [](VertexKind k) { return k != VertexKind::isolated; });
  return used - E.rows() + F.rows() - static_cast<std::int64_t>(defects.repeated_corner.size());
}

Topology build_topology(Index vertex_count, const Triangles& F, std::vector<Index> zero_area) {
  Topology topology;
  topology.vertex_count = vertex_count;
  topology.F = F;
  topology.stars = vertex_stars(vertex_count, F);
  find_edges(topology);

  topology.usable.assign(static_cast<std::size_t>(F.rows()), 1);
  for (Index t = 0; t < F.rows(); ++t) {
    if (repeats_corner(F, t)) {
      topology.defects.repeated_corner.push_back(t);
      topology.usable[t] = 0;
    }
  }
  std::erase_if(zero_area, [&](Index t) { return repeats_corner(F, t); });
  topology.defects.zero_area = std::move(zero_area);
  topology.defects.duplicate = find_duplicates(topology);
  for (const auto* triangles : {&topology.defects.zero_area, &topology.defects.duplicate}) {
    for (const Index t : *triangles) {
      topology.usable[t] = 0;
    }
  }

  orient_coherently(topology);
  find_hinges(topology);
  find_components(topology);
  const Fans fans(topology);
  classify_vertices(topology, fans);
  mark_defective_vertices(topology);
  topology.boundary_loops = find_boundary_loops(topology, fans);
  return topology;
}

Topology build_topology(const Points& X, const Triangles& F) {
  return build_topology(static_cast<Index>(X.rows()), F, degenerate_triangles(X, F));
}

std::vector<std::uint8_t> grow_one_ring(const Topology& topology,
                                        const std::vector<std::uint8_t>& vertices) {
  std::vector<std::uint8_t> grown = vertices;
  for (const auto edge : topology.E.rowwise()) {
    if (vertices[edge[0]] || vertices[edge[1]]) {
      grown[edge[0]] = grown[edge[1]] = 1;
    }
  }
  return grown;
}

}  // namespace ibmfair
