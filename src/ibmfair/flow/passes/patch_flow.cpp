#include "ibmfair/flow/passes/patch_flow.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "ibmfair/base/errors.h"
#include "ibmfair/flow/linear_system/jacobian_solver.h"
#include "ibmfair/flow/steps/guarded_flow.h"

namespace ibmfair {
namespace {

/// The options of the flow of the mesh, without the lists per vertex and per triangle. Patches use
/// the last backend of the mesh if it is in the table of backends.
FlowOptions options_for_patches(const FlowProblem& problem) {
  const FlowOptions& options = problem.options;
  FlowOptions result;
  result.laplacian = options.laplacian;
  result.mass = options.mass;
  result.mass_matrix = options.mass_matrix;
  result.sharp_angle = options.sharp_angle;
  result.metric = options.metric;
  result.newton_iterations = options.newton_iterations;
  result.relax = options.relax;
  result.relax_along_creases = options.relax_along_creases;
  result.max_move = options.max_move;
  result.solver_tolerance = options.solver_tolerance;
  const std::string& taken = problem.report.solver;
  const auto has_that_name = [&](const JacobianBackend& backend) { return backend.name == taken; };
  if (std::ranges::any_of(jacobian_backends(), has_that_name)) {
    result.solver = taken;
  }
  result.clean_up = false;
  return result;
}

}  // namespace

std::vector<VertexPatch> patches_of(const std::vector<std::uint8_t>& wanted,
                                    const CompressedRows& rings, const FlowProblem& problem) {
  const Unknowns& unknowns = problem.unknowns;
  const auto is_own = [&](Index v) { return problem.parts.owns_vertex(v); };
  std::vector<std::uint8_t> left(wanted.size());
  for (const Index v : unknowns.vertex) {
    left[v] = wanted[v] != 0 && std::ranges::all_of(rings[v], is_own);
  }
  std::vector<VertexPatch> patches;
  for (const Index seed : unknowns.vertex) {
    if (left[seed] == 0) {
      continue;
    }
    left[seed] = 0;
    VertexPatch patch{seed};
    for (std::size_t i = 0; i < patch.size(); ++i) {
      for (const Index q : rings[patch[i]]) {
        if (left[q] != 0) {
          left[q] = 0;
          patch.push_back(q);
        }
      }
    }
    std::ranges::sort(patch);
    patches.push_back(std::move(patch));
  }
  return patches;
}

PatchFlow::PatchFlow(const FlowProblem& problem, const CompressedRows& rings)
    : problem_(problem),
      rings_(rings),
      options_(options_for_patches(problem)),
      is_near_(static_cast<std::size_t>(problem.topology.vertex_count), 0),
      place_(is_near_.size()) {}

bool PatchFlow::run(const VertexPatch& patch, const Points& X, double time, Points& move) {
  const FlowOptions& whole = problem_.options;
  LocalMesh local = cut_out(patch);
  local.options.total_time = time;
  local.options.steps =
      std::max(1, static_cast<int>(std::lround(whole.steps * time / whole.total_time)));
  // FlowProblem measures the bound on moves from the positions that it is constructed with.
  FlowProblem problem(local.X, local.topology, local.fixed, local.options);
  Points Y = problem_.X(local.vertex, Eigen::all);
  problem.move_to(Y);
  problem.update_gradient();
  const double energy = problem.energy();
  Y = X(local.vertex, Eigen::all);
  problem.move_to(Y);
  try {
    const FoldWatch folds(problem.X, problem.topology);
    run_guarded(problem, vertex_rings(problem.topology), folds, {});
  } catch (const FactorizationFailed&) {
    return false;
  }
  problem.update_gradient();
  if (!(problem.energy() < energy)) {
    return false;
  }
  for (const Index i : problem.unknowns.vertex) {
    const Index v = local.vertex[i];
    move.row(problem_.unknowns.unknown[v]) = problem.X.row(i) - problem_.X.row(v);
  }
  return true;
}

/// Cuts out all triangles at the patch and at its neighbours: no vertex farther away is in a
/// stencil that the patch moves, or in the mass of such a stencil.
LocalMesh PatchFlow::cut_out(const VertexPatch& patch) {
  const std::lock_guard lock(cutting_);
  const Topology& topology = problem_.topology;
  std::vector<Index> vertices, triangles;
  const auto take = [&](Index v) {
    if (is_near_[v] == 0) {
      is_near_[v] = 1;
      vertices.push_back(v);
    }
  };
  const auto sort_once = [](std::vector<Index>& list) {
    std::ranges::sort(list);
    list.erase(std::unique(list.begin(), list.end()), list.end());
  };
  for (const Index v : patch) {
    take(v);
    std::ranges::for_each(rings_[v], take);
  }
  for (const Index v : vertices) {
    const auto star = topology.stars[v];
    triangles.insert(triangles.end(), star.begin(), star.end());
  }
  sort_once(triangles);
  for (const Index t : triangles) {
    for (int i = 0; i < 3; ++i) {
      take(topology.F(t, i));
    }
  }
  std::ranges::sort(vertices);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    is_near_[vertices[i]] = 0;
    place_[vertices[i]] = static_cast<Index>(i);
  }
  LocalMesh local =
      some_of_mesh(problem_.start(), topology, std::move(vertices), triangles, place_);
  for (const Index v : patch) {
    local.fixed[place_[v]] = 0;
  }
  local.options = options_;
  take_lists(problem_.options, local.vertex, triangles, local.options);
  return local;
}

}  // namespace ibmfair
