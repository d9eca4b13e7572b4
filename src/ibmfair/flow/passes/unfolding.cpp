#include "ibmfair/flow/passes/unfolding.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "ibmfair/flow/steps/folds.h"
#include "ibmfair/flow/tuning.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

/// Flags (#V) of the vertices at foldovers, and of their neighbours, that may be unfolded.
std::vector<std::uint8_t> vertices_at_folds(const FlowProblem& problem,
                                            const CompressedRows& rings) {
  const Topology& topology = problem.topology;
  const auto may_move = [&](Index v) {
    const Index u = problem.unknowns.unknown[v];
    return is_oriented_interior(topology, v) && u >= 0 && u < problem.unknowns.size();
  };
  const std::vector<std::uint8_t> folded = folded_hinges(problem.X, topology, tuning.clean_up.fold);
  std::vector<std::uint8_t> wanted(static_cast<std::size_t>(topology.vertex_count), 0);
  for (Index h = 0; h < topology.H.rows(); ++h) {
    for (int i = 0; i < 2; ++i) {
      if (const Index v = topology.H(h, i); folded[h] && may_move(v)) {
        wanted[v] = 1;
        for (const Index q : rings[v]) {
          wanted[q] = may_move(q) ? 1 : 0;
        }
      }
    }
  }
  return wanted;
}

}  // namespace

std::vector<VertexPatch> find_folded_patches(const FlowProblem& problem,
                                             const CompressedRows& rings, double flat) {
  std::vector<VertexPatch> found = patches_of(vertices_at_folds(problem, rings), rings, problem);
  std::erase_if(found, [&](const VertexPatch& patch) {
    return patch.size() > tuning.clean_up.largest_fold ||
           !is_flat_around(patch, problem.X, problem.topology, rings, flat);
  });
  return found;
}

bool is_flat_around(const VertexPatch& patch, const Points& X, const Topology& topology,
                    const CompressedRows& rings, double flat) {
  const auto inside = [&](Index v) { return std::binary_search(patch.begin(), patch.end(), v); };
  std::vector<Index> around;
  for (const Index v : patch) {
    for (const Index q : rings[v]) {
      if (!inside(q)) {
        const auto star = topology.stars[q];
        around.insert(around.end(), star.begin(), star.end());
      }
    }
  }
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  Vec3 sum = Vec3::Zero();
  double length = 0;
  for (const Index t : around) {
    const auto x = topology.F.row(t);
    if (std::none_of(x.begin(), x.end(), inside)) {
      const Vec3 N = double_area_vector(X, topology.F, t);
      sum += N;
      length += N.norm();
    }
  }
  return sum.norm() > flat * length;
}

void even_out(const VertexPatch& patch, const CompressedRows& rings, Points& X) {
  for (int i = 0; i < tuning.clean_up.sweeps; ++i) {
    for (const Index v : patch) {
      Vec3 mean = Vec3::Zero();
      for (const Index q : rings[v]) {
        mean += X.row(q);
      }
      X.row(v) = mean / static_cast<double>(rings[v].size());
    }
  }
}

}  // namespace ibmfair
