#include "ibmfair/flow/passes/meeting_lines.h"

#include <algorithm>
#include <array>
#include <unordered_map>

#include "ibmfair/flow/passes/curve_flow.h"
#include "ibmfair/flow/steps/folds.h"
#include "ibmfair/flow/steps/move_bound.h"
#include "ibmfair/flow/tuning.h"

namespace ibmfair {
namespace {

/// The graph of the edges at which sheets meet.
class MeetingEdges {
 public:
  explicit MeetingEdges(const Topology& topology) {
    std::vector<std::uint8_t> odd(static_cast<std::size_t>(topology.F.rows()), 0);
    for (const auto* list : {&topology.defects.duplicate, &topology.defects.repeated_corner,
                             &topology.defects.zero_area}) {
      for (const Index t : *list) {
        odd[t] = 1;
      }
    }
    for (const Index e : topology.defects.non_manifold_edges) {
      if (std::ranges::none_of(topology.edge_triangles[e], [&](Index t) { return odd[t]; })) {
        const Index a = topology.E(e, 0), b = topology.E(e, 1);
        neighbours_[a].push_back(b);
        neighbours_[b].push_back(a);
        starts_.push_back(a);
        starts_.push_back(b);
      }
    }
    std::ranges::sort(starts_);
    starts_.erase(std::ranges::unique(starts_).begin(), starts_.end());
    for (Index e = 0; e < topology.E.rows(); ++e) {
      if (topology.edge_triangles[e].size() == 1) {
        is_end_[topology.E(e, 0)] = is_end_[topology.E(e, 1)] = true;
      }
    }
  }

  std::vector<MeetingLine> lines() {
    std::vector<MeetingLine> result;
    for (const bool from_ends : {true, false}) {  // what is left after the first round is closed
      for (const Index v : starts_) {
        if (ends_at(v) != from_ends) {
          continue;
        }
        for (const Index w : neighbours_.at(v)) {
          if (is_used(v, w)) {
            continue;
          }
          result.push_back(walk(v, w));
        }
      }
    }
    return result;
  }

 private:
  bool ends_at(Index v) const { return neighbours_.at(v).size() != 2 || is_end_.contains(v); }

  bool is_used(Index v, Index w) const {
    const auto found = used_.find(v);
    return found != used_.end() && std::ranges::find(found->second, w) != found->second.end();
  }

  MeetingLine walk(Index v, Index w) {
    MeetingLine line;
    const Index first = v;
    line.vertices.push_back(v);
    for (;;) {
      used_[v].push_back(w);
      used_[w].push_back(v);
      if (w == first && !ends_at(w)) {
        line.closed = true;
        return line;
      }
      line.vertices.push_back(w);
      if (ends_at(w)) {
        return line;
      }
      const std::vector<Index>& next = neighbours_.at(w);
      const Index before = v;
      v = w;
      w = next[next[0] == before ? 1 : 0];
    }
  }

  std::unordered_map<Index, std::vector<Index>> neighbours_, used_;
  std::unordered_map<Index, bool> is_end_;
  std::vector<Index> starts_;  // sorted
};

}  // namespace

std::vector<MeetingLine> find_meeting_lines(const Topology& topology) {
  if (topology.defects.non_manifold_edges.empty()) {
    return {};
  }
  return MeetingEdges(topology).lines();
}

void fair_meeting_lines(const std::vector<MeetingLine>& lines, const Topology& topology,
                        double cutoff, const Eigen::VectorXd& cutoff_factor, double max_move,
                        Points& X) {
  const FoldWatch folds(X, topology);
  Points move = Points::Zero(X.rows(), 3);
  for (const MeetingLine& line : lines) {
    CurveFlowOptions options;
    options.cutoff = tuning.meeting_lines.of_cutoff * cutoff;
    options.twicing = 1;
    if (cutoff_factor.size() > 0) {
      options.cutoff_factor = cutoff_factor(line.vertices);
    }
    const Points before = X(line.vertices, Eigen::all);
    const auto ends = line.closed ? CurveEnds::closed : CurveEnds::natural;
    move(line.vertices, Eigen::all) = curve_flow(before, ends, options) - before;
  }
  const MoveBound bound(X, max_move);
  for (int i = 0; i <= tuning.guard.most_withholdings; ++i) {
    Points Y = X + move;
    for (const MeetingLine& line : lines) {
      for (const Index v : line.vertices) {
        Y.row(v) = bound.within(v, Y.row(v));
      }
    }
    std::vector<std::uint8_t> near(static_cast<std::size_t>(topology.vertex_count), 0);
    const std::vector<Index> folded = folds.new_folds(Y);
    if (folded.empty()) {
      X.swap(Y);
      return;
    }
    for (const Index v : folded) {
      near[v] = 1;
    }
    near = grow_one_ring(topology, near);
    for (Index v = 0; v < topology.vertex_count; ++v) {
      move.row(v) *= near[v] ? 0.5 : 1.0;
    }
  }
}

}  // namespace ibmfair
