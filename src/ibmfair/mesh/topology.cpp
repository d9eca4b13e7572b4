#include "ibmfair/mesh/topology.h"

#include <algorithm>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/parallel.h"
#include "ibmfair/mesh/boundary_loops.h"
#include "ibmfair/mesh/corners.h"
#include "ibmfair/mesh/edges.h"
#include "ibmfair/mesh/fans.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/mesh/mesh.h"
#include "ibmfair/mesh/orientation.h"
#include "ibmfair/mesh/select.h"
#include "ibmfair/mesh/union_find.h"

namespace ibmfair {
namespace {

/// Two triangles with the same three vertices share all their edges, and their vertices opposite
/// each edge are the same.
std::vector<Index> find_duplicates(const Topology& topology, const EdgeSides& sides) {
  const CompressedRows& triangles = topology.edge_triangles;
  const auto suspicious = [&](Index e) {
    const std::int64_t i = triangles.first[e], count = triangles.first[e + 1] - i;
    return count > 2 || (count == 2 && sides.opposite(i) == sides.opposite(i + 1));
  };
  std::vector<Index> duplicates;
  std::vector<std::pair<Index, Index>> around;  // opposite vertex, triangle
  for (const Index e : indices_where(topology.E.rows(), suspicious)) {
    around.clear();
    for (std::int64_t i = triangles.first[e]; i < triangles.first[e + 1]; ++i) {
      around.emplace_back(sides.opposite(i), triangles.value[i]);
    }
    std::sort(around.begin(), around.end());
    for (std::size_t i = 1; i < around.size(); ++i) {
      if (around[i].first == around[i - 1].first) {
        duplicates.insert(duplicates.end(), {around[i - 1].second, around[i].second});
      }
    }
  }
  std::sort(duplicates.begin(), duplicates.end());
  duplicates.erase(std::unique(duplicates.begin(), duplicates.end()), duplicates.end());
  return duplicates;
}

void find_unusable_triangles(Topology& topology, const EdgeSides& sides,
                             std::vector<Index> zero_area) {
  const auto repeats = [&](Index t) { return repeats_corner(topology.F, t); };
  Defects& defects = topology.defects;
  defects.repeated_corner = indices_where(topology.F.rows(), repeats);
  std::erase_if(zero_area, repeats);
  defects.zero_area = std::move(zero_area);
  defects.duplicate = find_duplicates(topology, sides);
  topology.usable.assign(static_cast<std::size_t>(topology.F.rows()), 1);
  for (const auto* triangles : {&defects.repeated_corner, &defects.zero_area, &defects.duplicate}) {
    for (const Index t : *triangles) {
      topology.usable[t] = 0;
    }
  }
}

void find_hinges(Topology& topology, const EdgeSides& sides) {
  const std::vector<Index> edges = indices_where(topology.E.rows(), [&](Index e) {
    const auto t = topology.edge_triangles[e];
    return t.size() == 2 && topology.usable[t[0]] && topology.usable[t[1]];
  });
  const auto count = static_cast<Eigen::Index>(edges.size());
  topology.H.resize(count, 4);
  topology.hinge_triangles.resize(count, 2);
  parallel_for(count, [&](std::int64_t h) {
    const Index e = edges[h];
    Index a = topology.E(e, 0), b = topology.E(e, 1);
    std::int64_t side0 = topology.edge_triangles.first[e], side1 = side0 + 1;
    if (!sides.runs_up(side0)) {
      if (sides.runs_up(side1)) {
        std::swap(side0, side1);
      } else {  // the two triangles disagree: the edge lies on a non-orientable cut
        std::swap(a, b);
      }
    }
    topology.H.row(h) << a, b, sides.opposite(side0), sides.opposite(side1);
    topology.hinge_triangles.row(h) << topology.edge_triangles.value[side0],
        topology.edge_triangles.value[side1];
  });
}

/// Numbers the components in the order of their smallest vertices, which represent their sets.
void find_components(Topology& topology) {
  UnionFind sets(topology.vertex_count);
  for (const auto edge : topology.E.rowwise()) {
    sets.unite(edge[0], edge[1]);
  }
  topology.component.assign(static_cast<std::size_t>(topology.vertex_count), -1);
  for (Index v = 0; v < topology.vertex_count; ++v) {
    if (!topology.stars[v].empty()) {
      const Index smallest = sets.find(v);
      topology.component[v] =
          smallest == v ? topology.component_count++ : topology.component[smallest];
    }
  }
}

/// Classifies vertices as isolated, interior, boundary or irregular by the number of triangles at
/// their edges. Bow-ties are found later.
void classify_by_edges(Topology& topology) {
  topology.kind.assign(static_cast<std::size_t>(topology.vertex_count), VertexKind::interior);
  parallel_for(topology.vertex_count, [&](std::int64_t v) {
    if (topology.stars[static_cast<Index>(v)].empty()) {
      topology.kind[v] = VertexKind::isolated;
    }
  });
  for (const Index e : indices_where(
           topology.E.rows(), [&](Index e) { return topology.edge_triangles[e].size() != 2; })) {
    const bool manifold = topology.edge_triangles[e].size() == 1;
    for (const Index v : {topology.E(e, 0), topology.E(e, 1)}) {
      if (!manifold) {
        topology.kind[v] = VertexKind::irregular;
      } else if (topology.kind[v] == VertexKind::interior) {
        topology.kind[v] = VertexKind::boundary;
      }
    }
    if (!manifold) {
      topology.defects.non_manifold_edges.push_back(e);
    }
  }
}

void find_bow_ties(Topology& topology) {
  topology.defects.bow_tie_vertices = indices_where(topology.vertex_count, [&](Index v) {
    const VertexKind kind = topology.kind[v];
    return (kind == VertexKind::interior || kind == VertexKind::boundary) &&
           !is_one_fan(topology, v);
  });
  for (const Index v : topology.defects.bow_tie_vertices) {
    topology.kind[v] = VertexKind::irregular;
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

void require_countable(std::int64_t vertices, std::int64_t triangles) {
  if (vertices > most_elements || triangles > most_elements) {
    throw BadMesh(fmt::format("{} vertices and {} triangles: there may be {} of each at most",
                              vertices, triangles, most_elements));
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

Topology build_topology(Index vertex_count, Triangles F, std::vector<Index> zero_area) {
  require_countable(vertex_count, F.rows());
  Topology topology;
  topology.vertex_count = vertex_count;
  topology.F = std::move(F);
  topology.stars = vertex_stars(vertex_count, topology.F);
  EdgeSides sides = find_edges(topology);
  find_unusable_triangles(topology, sides, std::move(zero_area));
  orient_coherently(topology, sides);
  find_hinges(topology, sides);
  find_components(topology);
  classify_by_edges(topology);
  find_bow_ties(topology);
  mark_defective_vertices(topology);
  topology.boundary_loops = find_boundary_loops(topology);
  return topology;
}

Topology build_topology(const Points& X, Triangles F) {
  require_countable(X.rows(), F.rows());
  std::vector<Index> zero_area = degenerate_triangles(X, F);
  return build_topology(static_cast<Index>(X.rows()), std::move(F), std::move(zero_area));
}

bool is_ringed(const Topology& topology, Index v) {
  return is_oriented_interior(topology, v) && topology.stars[v].size() <= most_in_short_star;
}

CompressedRows vertex_rings(const Topology& topology) {
  const std::span<const Index> ends(topology.E.data(), static_cast<std::size_t>(topology.E.size()));
  CompressedRows rings = positions_by_value(ends, topology.vertex_count);
  parallel_for(topology.vertex_count, [&](std::int64_t i) {
    const auto v = static_cast<Index>(i);
    Index* const ring = rings.value.data() + rings.first[v];
    if (is_ringed(topology, v)) {
      walk_around(topology, v, ring);
      return;
    }
    for (Index* place = ring; place != rings.value.data() + rings.first[v + 1]; ++place) {
      *place = ends[*place ^ 1];  // the vertex at the other end of the edge
    }
  });
  return rings;
}

std::vector<std::uint8_t> grow_one_ring(const Topology& topology,
                                        const std::vector<std::uint8_t>& vertices) {
  std::vector<std::uint8_t> grown(vertices.size());
  parallel_for(topology.vertex_count, [&](std::int64_t v) {
    const auto star = topology.stars[static_cast<Index>(v)];
    grown[v] = vertices[v] || std::any_of(star.begin(), star.end(), [&](Index t) {
                 return vertices[topology.F(t, 0)] || vertices[topology.F(t, 1)] ||
                        vertices[topology.F(t, 2)];
               });
  });
  return grown;
}

}  // namespace ibmfair
