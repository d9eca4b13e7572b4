#include "ibmfair/flow/passes/residual_spikes.h"

#include <algorithm>
#include <cstdint>
#include <numbers>

#include "ibmfair/base/stopwatch.h"
#include "ibmfair/flow/passes/clean_up.h"
#include "ibmfair/flow/passes/unfolding.h"
#include "ibmfair/flow/steps/guarded_move.h"
#include "ibmfair/flow/tuning.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

/// Whether the sharp hinges of a patch form open lines without branches, as a crease does.
/// `sharp_at`: #V, the number of sharp hinges at each vertex.
bool is_a_line(const VertexPatch& patch, const std::vector<Index>& sharp_at) {
  Index ends = 0;
  for (const Index v : patch) {
    if (sharp_at[v] > 2) {
      return false;
    }
    ends += sharp_at[v] == 1;
  }
  return ends > 0;
}

/// Whether sharp hinges continue from a patch to vertices outside of it, which are fixed, at a
/// boundary or belong to another part.
bool leads_on(const VertexPatch& patch, const CompressedRows& rings,
              const std::vector<Index>& sharp_at) {
  return std::ranges::any_of(patch, [&](Index v) {
    return std::ranges::any_of(rings[v], [&](Index q) {
      return sharp_at[q] > 0 && !std::ranges::binary_search(patch, q);
    });
  });
}

}  // namespace

std::vector<VertexPatch> find_residual_spikes(const FlowProblem& problem,
                                              const CompressedRows& rings) {
  const Points& X = problem.X;
  const Topology& topology = problem.topology;
  const Eigen::VectorXd angles = dihedral_angles(X, topology.H);
  const double sharp = tuning.spikes.sharp_share * problem.options.sharp_angle;
  std::vector<Index> sharp_at(static_cast<std::size_t>(topology.vertex_count), 0);
  std::vector<std::uint8_t> wanted(sharp_at.size(), 0);
  for (Index h = 0; h < topology.H.rows(); ++h) {
    if (std::numbers::pi - angles[h] > sharp) {
      for (const Index v : {topology.H(h, 0), topology.H(h, 1)}) {
        ++sharp_at[v];
        wanted[v] = is_oriented_interior(topology, v) ? 1 : 0;
      }
    }
  }
  std::vector<VertexPatch> found = patches_of(wanted, rings, problem);
  std::erase_if(found, [&](const VertexPatch& patch) {
    return patch.size() > tuning.spikes.largest || is_a_line(patch, sharp_at) ||
           leads_on(patch, rings, sharp_at) ||
           !is_flat_around(patch, X, topology, rings, tuning.spikes.flat);
  });
  return found;
}

void flatten_residual_spikes(FlowProblem& problem, const CompressedRows& rings) {
  FlowReport& report = problem.report;
  const Stopwatch watch(report.seconds.guard);
  Points move;
  if (!even_out_and_flow(problem, rings, find_residual_spikes(problem, rings), move)) {
    return;
  }
  const FoldWatch folds(problem.X, problem.topology);
  if (GuardedMove(problem, folds).make(move, report.energy_after, 0)) {
    report.unfolded += problem.moved(move);
    if (!report.steps.empty()) {
      report.steps.back().energy = report.energy_after;
    }
  }
}

}  // namespace ibmfair
