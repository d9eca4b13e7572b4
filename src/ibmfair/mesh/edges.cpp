// Stars and edges are found by counting sorts, which take time linear in the size of the mesh and
// have almost no branches that a processor cannot predict.
#include "ibmfair/mesh/edges.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "ibmfair/base/parallel.h"
#include "ibmfair/mesh/corners.h"

namespace ibmfair {
namespace {

/// Assigns places in a flat list of rows. First count() is called for every item, then begin(), and
/// then take() for every item returns the next free place in the row of the item.
class RowPlaces {
 public:
  explicit RowPlaces(Index rows) : next_(static_cast<std::size_t>(rows) + 2, 0) {}

  void count(Index row) { ++next_[static_cast<std::size_t>(row) + 2]; }
  void begin() { std::partial_sum(next_.begin(), next_.end(), next_.begin()); }
  std::int64_t total() const { return next_.back(); }
  std::int64_t take(Index row) { return next_[static_cast<std::size_t>(row) + 1]++; }

  /// The start of each row and the end of the last row. Call this after every place has been taken.
  std::vector<std::int64_t> first() && {
    next_.pop_back();
    return std::move(next_);
  }

 private:
  // Element r + 1 is the next free place of row r; when all places are taken, this is the start of
  // row r + 1.
  std::vector<std::int64_t> next_;
};

/// A side of a triangle, stored in the row of its smaller vertex.
struct HalfEdge {
  Index larger;  // the larger vertex of the side
  Index triangle;
  Index opposite;  // as in EdgeSides
};

/// The half-edges of all triangles without a repeated corner, in rows by their smaller vertex. Each
/// row is ordered by the larger vertex and then by triangle.
struct HalfEdges {
  std::vector<std::int64_t> first;  // #V + 1
  std::vector<HalfEdge> value;      // three for each of these triangles

  /// Whether half-edge i of row v is the first half-edge of its edge.
  bool starts_edge(Index v, std::int64_t i) const {
    return i == first[v] || value[i].larger != value[i - 1].larger;
  }
};

RowPlaces places_by_smaller_vertex(const Topology& topology) {
  RowPlaces places(topology.vertex_count);
  for (Index t = 0; t < topology.F.rows(); ++t) {
    if (!repeats_corner(topology.F, t)) {
      const Index a = topology.F(t, 0), b = topology.F(t, 1), c = topology.F(t, 2);
      places.count(std::min(a, b));
      places.count(std::min(b, c));
      places.count(std::min(c, a));
    }
  }
  places.begin();
  return places;
}

/// Visits the larger vertices in increasing order, so that every row comes out sorted.
HalfEdges find_half_edges(const Topology& topology) {
  RowPlaces places = places_by_smaller_vertex(topology);
  HalfEdges half_edges;
  half_edges.value.resize(static_cast<std::size_t>(places.total()));
  const auto put = [&](Index smaller, const HalfEdge& half_edge) {
    if (smaller < half_edge.larger) {  // otherwise stored from its other end
      half_edges.value[places.take(smaller)] = half_edge;
    }
  };
  for (Index v = 0; v < topology.vertex_count; ++v) {
    for (const Index t : topology.stars[v]) {
      const auto [next, previous] = other_corners(topology.F, t, v);
      put(next, {v, t, ~previous});
      put(previous, {v, t, next});
    }
  }
  half_edges.first = std::move(places).first();
  return half_edges;
}

/// The number of the first edge of each row of half-edges, followed by the total number of edges.
std::vector<Index> number_edges(const HalfEdges& half_edges, Index vertex_count) {
  std::vector<Index> first_edge(static_cast<std::size_t>(vertex_count) + 1, 0);
  parallel_for(vertex_count, [&](std::int64_t v) {
    Index edges = 0;
    for (std::int64_t i = half_edges.first[v]; i < half_edges.first[v + 1]; ++i) {
      edges += half_edges.starts_edge(static_cast<Index>(v), i) ? 1 : 0;
    }
    first_edge[v + 1] = edges;
  });
  std::partial_sum(first_edge.begin(), first_edge.end(), first_edge.begin());
  return first_edge;
}

}  // namespace

CompressedRows vertex_stars(Index vertex_count, const Triangles& F) {
  RowPlaces places(vertex_count);
  const auto each = [&](auto&& act) {
    for (Index t = 0; t < F.rows(); ++t) {
      if (!repeats_corner(F, t)) {
        for (int i = 0; i < 3; ++i) {
          act(F(t, i), t);
        }
      }
    }
  };
  each([&](Index v, Index) { places.count(v); });
  places.begin();
  CompressedRows stars;
  stars.value.resize(static_cast<std::size_t>(places.total()));
  each([&](Index v, Index t) { stars.value[places.take(v)] = t; });
  stars.first = std::move(places).first();
  return stars;
}

EdgeSides find_edges(Topology& topology) {
  const HalfEdges half_edges = find_half_edges(topology);
  const std::vector<Index> first_edge = number_edges(half_edges, topology.vertex_count);
  const auto sides = static_cast<std::size_t>(half_edges.first.back());
  CompressedRows& triangles = topology.edge_triangles;
  topology.E.resize(first_edge.back(), 2);
  triangles.first.resize(static_cast<std::size_t>(first_edge.back()) + 1);
  triangles.first.back() = half_edges.first.back();
  triangles.value.resize(sides);
  std::vector<Index> opposite(sides);
  parallel_for(topology.vertex_count, [&](std::int64_t v) {
    Index e = first_edge[v];
    for (std::int64_t i = half_edges.first[v]; i < half_edges.first[v + 1]; ++i) {
      if (half_edges.starts_edge(static_cast<Index>(v), i)) {
        topology.E(e, 0) = static_cast<Index>(v);
        topology.E(e, 1) = half_edges.value[i].larger;
        triangles.first[e++] = i;
      }
      triangles.value[i] = half_edges.value[i].triangle;
      opposite[i] = half_edges.value[i].opposite;
    }
  });
  return EdgeSides(std::move(opposite));
}

}  // namespace ibmfair
