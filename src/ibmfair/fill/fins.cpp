#include "ibmfair/fill/fins.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "ibmfair/base/quantile.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/mesh/union_find.h"

namespace ibmfair {
namespace {

// A fin has at most this many triangles, or this share of those of the surface that it stands on.
constexpr Index few_triangles = 4;
constexpr double small_share = 0.01;

// A triangle stands up from the mesh if it bends by more than both.
constexpr double least_steep_angle = 0.5;    // radians
constexpr double steep_in_median_bends = 8;  // of the surrounding triangles

class ProtrudingTriangles {
 public:
  ProtrudingTriangles(Patch& patch, const std::vector<Index>& around)
      : patch_(patch), around_(around), stays_(around.size(), 1) {
    for (const RimEdge& edge : patch.rim) {
      outer_.add(edge.a, edge.b);
    }
  }

  void leave_out() {
    bool found = false;
    for (Index t = 0; t < patch_.surroundings.rows(); ++t) {
      if (leave_out_if_steep(t)) {
        found = true;
        t = -1;  // its neighbour may hang by one edge now
      }
    }
    if (found) {
      std::vector<Index> kept;
      for (std::size_t t = 0; t < stays_.size(); ++t) {
        if (stays_[t]) {
          kept.push_back(static_cast<Index>(t));
        }
      }
      patch_.surroundings = Triangles(patch_.surroundings(kept, Eigen::all));
    }
  }

 private:
  bool leave_out_if_steep(Index t) {
    const auto x = patch_.surroundings.row(t);
    int outer_edges = 0, base = 0;
    for (int i = 0; i < 3; ++i) {
      const bool is_outer = outer_.contains(x[i], x[(i + 1) % 3]);
      outer_edges += is_outer ? 1 : 0;
      base = is_outer ? base : i;
    }
    if (!stays_[t] || outer_edges != 2) {
      return false;
    }
    const Index other = beyond(t, base);
    if (other < 0 || !(bend(t, other) > steep_angle())) {
      return false;
    }
    stays_[t] = 0;
    outer_.add(x[base], x[(base + 1) % 3]);
    patch_.protruding.push_back(around_[t]);
    return true;
  }

  /// The triangle on the other side of an edge, if there is exactly one.
  Index beyond(Index t, int corner) {
    if (sides_.empty()) {
      list_sides();
    }
    const auto [a, b] = ends(t, corner);
    const auto first = std::lower_bound(sides_.begin(), sides_.end(), Side{a, b, -1});
    const auto is_there = [&](auto it) {
      return it != sides_.end() && (*it)[0] == a && (*it)[1] == b;
    };
    if (!is_there(first + 1) || is_there(first + 2)) {
      return -1;
    }
    return (*first)[2] == t ? (*(first + 1))[2] : (*first)[2];
  }

  void list_sides() {
    for (Index t = 0; t < patch_.surroundings.rows(); ++t) {
      for (int i = 0; i < 3; ++i) {
        const auto [a, b] = ends(t, i);
        sides_.push_back({a, b, t});
      }
    }
    std::ranges::sort(sides_);
  }

  std::pair<Index, Index> ends(Index t, int corner) const {
    const Index a = patch_.surroundings(t, corner), b = patch_.surroundings(t, (corner + 1) % 3);
    return {std::min(a, b), std::max(a, b)};
  }

  double bend(Index t, Index u) const {
    const Vec3 N = double_area_vector(patch_.X, patch_.surroundings, t);
    const Vec3 M = double_area_vector(patch_.X, patch_.surroundings, u);
    return std::atan2(N.cross(M).norm(), N.dot(M));
  }

  double steep_angle() {
    if (steep_angle_ == 0) {
      std::vector<double> bends{0};
      for (std::size_t i = 0; i + 1 < sides_.size(); ++i) {
        const Side &side = sides_[i], &next = sides_[i + 1];
        if (side[0] == next[0] && side[1] == next[1]) {
          bends.push_back(bend(side[2], next[2]));
        }
      }
      steep_angle_ = std::max(least_steep_angle, steep_in_median_bends * median(bends));
    }
    return steep_angle_;
  }

  Patch& patch_;
  const std::vector<Index>& around_;
  std::vector<std::uint8_t> stays_;
  EdgeSet outer_;                     // edges with no triangle of the surroundings on one side
  using Side = std::array<Index, 3>;  // an edge, the smaller end first, and a triangle at the edge
  std::vector<Side> sides_;           // sorted; empty until they are needed
  double steep_angle_ = 0;            // 0: not computed yet
};

}  // namespace

std::vector<Index> find_fins(const Topology& topology) {
  if (topology.defects.non_manifold_edges.empty()) {
    return {};
  }
  UnionFind sheets(static_cast<Index>(topology.F.rows()));
  for (Index e = 0; e < topology.edge_triangles.size(); ++e) {
    if (const auto pair = topology.edge_triangles[e]; pair.size() == 2) {
      sheets.unite(pair[0], pair[1]);
    }
  }
  std::vector<Index> size(static_cast<std::size_t>(topology.F.rows()), 0);
  for (Index t = 0; t < topology.F.rows(); ++t) {
    ++size[sheets.find(t)];
  }
  std::vector<std::uint8_t> is_fin(size.size(), 0);  // by the representative of the sheet
  for (const Index e : topology.defects.non_manifold_edges) {
    Index surface = 0;  // the largest sheet that passes through the edge
    std::map<Index, int> count;
    for (const Index t : topology.edge_triangles[e]) {
      const Index sheet = sheets.find(t);
      if (++count[sheet] == 2) {
        surface = std::max(surface, size[sheet]);
      }
    }
    for (const auto& [sheet, times] : count) {
      const bool is_small = size[sheet] <= std::max(few_triangles, Index(small_share * surface));
      is_fin[sheet] = is_fin[sheet] || (surface > 0 && is_small && size[sheet] < surface) ? 1 : 0;
    }
  }
  std::vector<Index> fins;
  for (Index t = 0; t < topology.F.rows(); ++t) {
    if (is_fin[sheets.find(t)]) {
      fins.push_back(t);
    }
  }
  return fins;
}

Topology without_triangles(const Topology& topology, const std::vector<Index>& triangles) {
  Triangles F = topology.F;
  for (const Index t : triangles) {
    // Preferably at a vertex of this triangle only, which then counts as a defect.
    const auto x = topology.F.row(t);
    Index tip = x[0];
    for (const Index v : x) {
      tip = topology.stars[v].size() < topology.stars[tip].size() ? v : tip;
    }
    F.row(t).setConstant(tip);
  }
  return build_topology(topology.vertex_count, std::move(F), topology.defects.zero_area);
}

void leave_out_protruding(Patch& patch, const std::vector<Index>& around) {
  ProtrudingTriangles(patch, around).leave_out();
}

}  // namespace ibmfair
