#include "ibmfair/page/scene_lines.h"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>

#include "ibmfair/mesh/corners.h"

namespace ibmfair {
namespace {

constexpr std::size_t most_outlines = 1000;

SceneLine strip(std::string_view kind, std::string title, const Points& X,
                const std::vector<Index>& vertices, bool closed) {
  return {kind, std::move(title), X(vertices, Eigen::all), closed, -1};
}

/// Splits a set of edges into strips in which each edge occurs once.
class EdgeWalk {
 public:
  explicit EdgeWalk(const std::vector<std::array<Index, 2>>& edges) {
    for (const auto& [a, b] : edges) {
      next_.emplace(a, b);
      next_.emplace(b, a);
    }
  }

  /// Strips that together contain every edge; open strips come first.
  std::vector<std::vector<Index>> strips() {
    std::vector<Index> starts;
    for (auto at = next_.begin(); at != next_.end(); at = next_.upper_bound(at->first)) {
      starts.push_back(at->first);
    }
    std::stable_partition(starts.begin(), starts.end(),
                          [&](Index v) { return next_.count(v) % 2 == 1; });
    std::vector<std::vector<Index>> strips;
    for (const Index start : starts) {
      while (next_.contains(start)) {
        strips.push_back(walk(start));
      }
    }
    return strips;
  }

 private:
  std::vector<Index> walk(Index v) {
    std::vector<Index> strip{v};
    for (auto step = next_.find(v); step != next_.end(); step = next_.find(v)) {
      const Index w = step->second;
      next_.erase(step);
      const auto [first, last] = next_.equal_range(w);
      next_.erase(std::find_if(first, last, [&](const auto& back) { return back.second == v; }));
      strip.push_back(w);
      v = w;
    }
    return strip;
  }

  std::multimap<Index, Index> next_;
};

}  // namespace

std::vector<SceneLine> hole_lines(const Points& X, const std::vector<Hole>& holes) {
  std::vector<SceneLine> lines;
  for (const Hole& hole : holes) {
    lines.push_back(
        hole.outer_border
            ? strip("boundary", fmt::format("outer border {}", hole.id), X, hole.loop, hole.closed)
            : strip("hole", fmt::format("hole {}", hole.id), X, hole.loop, hole.closed));
    lines.back().hole = hole.id;
  }
  return lines;
}

SceneLine seam_line(const Points& X, const Hole& hole) {
  SceneLine line =
      strip("seam", fmt::format("seam of hole {}", hole.id), X, hole.loop, hole.closed);
  line.hole = hole.id;
  return line;
}

std::vector<SceneLine> defect_outlines(const Points& X, const Topology& topology) {
  std::vector<SceneLine> lines;
  const auto add_triangles = [&](const std::vector<Index>& triangles, std::string_view what) {
    for (std::size_t i = 0; i < std::min(most_outlines, triangles.size()); ++i) {
      const auto corners = topology.F.row(triangles[i]);
      lines.push_back(strip("defect", fmt::format("{} {}", what, triangles[i]), X,
                            {corners[0], corners[1], corners[2]}, true));
    }
  };
  const Defects& defects = topology.defects;
  add_triangles(defects.zero_area, "triangle without area");
  add_triangles(defects.duplicate, "duplicate triangle");
  for (std::size_t i = 0; i < std::min(most_outlines, defects.non_manifold_edges.size()); ++i) {
    const auto edge = topology.E.row(defects.non_manifold_edges[i]);
    lines.push_back(
        strip("defect", fmt::format("edge {}-{}", edge[0], edge[1]), X, {edge[0], edge[1]}, false));
  }
  return lines;
}

std::vector<SceneLine> fixed_lines(const Points& X, const Topology& topology,
                                   const std::vector<std::uint8_t>& fixed) {
  std::vector<std::array<Index, 2>> edges;
  for (Index e = 0; e < topology.E.rows(); ++e) {
    const Index a = topology.E(e, 0), b = topology.E(e, 1);
    const auto triangles = topology.edge_triangles[e];
    const bool borders = std::any_of(triangles.begin(), triangles.end(), [&](Index t) {
      return fixed[opposite_vertex(topology.F, t, a, b)] == 0;
    });
    if (fixed[a] != 0 && fixed[b] != 0 && borders) {
      edges.push_back({a, b});
    }
  }
  std::vector<SceneLine> lines;
  for (std::vector<Index>& vertices : EdgeWalk(edges).strips()) {
    const bool closed = vertices.front() == vertices.back();
    if (closed) {
      vertices.pop_back();
    }
    lines.push_back(strip("held", "border of the fixed vertices", X, vertices, closed));
  }
  return lines;
}

}  // namespace ibmfair
