#include "ibmfair/mesh/orientation.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "ibmfair/base/parallel.h"
#include "ibmfair/mesh/select.h"

namespace ibmfair {
namespace {

/// Whether edge e has exactly two triangles and both run along the edge in the same direction.
bool disagree_at(const Topology& topology, const EdgeSides& sides, Index e) {
  const std::int64_t i = topology.edge_triangles.first[e];
  return topology.edge_triangles.first[e + 1] == i + 2 && sides.runs_up(i) == sides.runs_up(i + 1);
}

/// For each triangle, the edges that it shares with exactly one other triangle, in increasing
/// order; -1 if there are fewer than three.
std::vector<std::array<Index, 3>> shared_edges(const Topology& topology) {
  std::vector<std::array<Index, 3>> edges(static_cast<std::size_t>(topology.F.rows()),
                                          {-1, -1, -1});
  for (Index e = 0; e < topology.E.rows(); ++e) {
    if (const auto triangles = topology.edge_triangles[e]; triangles.size() == 2) {
      for (const Index t : triangles) {
        *std::find(edges[t].begin(), edges[t].end(), -1) = e;
      }
    }
  }
  return edges;
}

/// Decides which triangles to turn, patch by patch.
class Orienter {
 public:
  Orienter(Topology& topology, const EdgeSides& sides)
      : topology_(topology),
        sides_(sides),
        edges_of_(shared_edges(topology)),
        turn_(static_cast<std::size_t>(topology.F.rows()), unseen) {}

  /// For each triangle, whether to reverse it, #F. If triangles cannot be made to agree at an edge,
  /// marks its vertices as twisted in the topology.
  std::vector<signed char> run() && {
    for (Index seed = 0; seed < static_cast<Index>(turn_.size()); ++seed) {
      if (turn_[seed] == unseen) {
        walk_patch(seed);
        keep_majority();
      }
    }
    return std::move(turn_);
  }

 private:
  static constexpr signed char unseen = -1;

  /// Decides for all triangles connected to `seed` whether to reverse them so that they agree with
  /// it.
  void walk_patch(Index seed) {
    patch_.assign(1, seed);
    turn_[seed] = 0;
    for (std::size_t next = 0; next < patch_.size(); ++next) {
      const Index t = patch_[next];
      for (const Index e : edges_of_[t]) {
        if (e < 0) {
          break;
        }
        const auto pair = topology_.edge_triangles[e];
        const Index other = pair[0] == t ? pair[1] : pair[0];
        const bool wanted = (turn_[t] == 1) != disagree_at(topology_, sides_, e);
        if (turn_[other] == unseen) {
          turn_[other] = wanted ? 1 : 0;
          patch_.push_back(other);
        } else if (turn_[other] != (wanted ? 1 : 0)) {
          topology_.orientable = false;
          topology_.twisted[topology_.E(e, 0)] = topology_.twisted[topology_.E(e, 1)] = 1;
        }
      }
    }
  }

  void keep_majority() {
    const auto turned =
        std::count_if(patch_.begin(), patch_.end(), [&](Index t) { return turn_[t] == 1; });
    if (2 * static_cast<std::size_t>(turned) > patch_.size()) {
      for (const Index t : patch_) {
        turn_[t] = turn_[t] == 1 ? 0 : 1;
      }
    }
  }

  Topology& topology_;
  const EdgeSides& sides_;
  std::vector<std::array<Index, 3>> edges_of_;
  std::vector<signed char> turn_;  // #F: whether to reverse the triangle, or unseen
  std::vector<Index> patch_;
};

void turn_triangles(const std::vector<signed char>& turn, Topology& topology, EdgeSides& sides) {
  parallel_for(topology.F.rows(), [&](std::int64_t t) {
    if (turn[t]) {
      std::swap(topology.F(t, 1), topology.F(t, 2));
    }
  });
  const std::vector<Index>& triangle = topology.edge_triangles.value;
  parallel_for(static_cast<std::int64_t>(triangle.size()), [&](std::int64_t i) {
    if (turn[triangle[i]]) {
      sides.turn(i);
    }
  });
  topology.turned_triangles = static_cast<Index>(std::count(turn.begin(), turn.end(), 1));
}

}  // namespace

void orient_coherently(Topology& topology, EdgeSides& sides) {
  topology.twisted.assign(static_cast<std::size_t>(topology.vertex_count), 0);
  const auto disagree = [&](Index e) { return disagree_at(topology, sides, e); };
  if (!indices_where(topology.E.rows(), disagree).empty()) {  // nearly every mesh is coherent
    turn_triangles(Orienter(topology, sides).run(), topology, sides);
  }
}

}  // namespace ibmfair
