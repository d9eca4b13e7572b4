#include "ibmfair/flow/settings/linear_smoother.h"

#include <cmath>

#include "ibmfair/base/errors.h"
#include "ibmfair/energy/mass_matrices.h"
#include "ibmfair/flow/flow_passes.h"
#include "ibmfair/flow/passes/linear_flow.h"
#include "ibmfair/flow/settings/choice_tuning.h"
#include "ibmfair/flow/steps/unknown_normals.h"
#include "ibmfair/flow/time_scale.h"

namespace ibmfair {
namespace {

constexpr std::size_t unlimited = 1 << 14;

/// The options of the flow without creases. What a solver without factorization leaves as residual
/// would be more than smooth shapes move in long trials.
FlowOptions for_trials(FlowOptions options) {
  options.sharp_angle = 0;
  if (options.solver == "auto") {
    options.solver = "multifrontal";
  }
  return options;
}

}  // namespace

bool is_linear(const FlowOptions& options) {
  const auto kind = mass_matrix(bending_model(options.laplacian), options.energy_options()).kind;
  const bool counted = kind == MassMatrix::Kind::counted;
  return options.laplacian == "umbrella" && (counted || kind == MassMatrix::Kind::identity) &&
         (counted || options.metric == Metric::identity) && options.guarded && !options.relax &&
         !options.put_back_slides && std::isinf(options.max_move) && !options.make_solver;
}

LinearSmoother::LinearSmoother(const TrialMesh& mesh, const Unknowns& unknowns)
    : mesh_(mesh),
      unknowns_(unknowns),
      options_(for_trials(mesh.options())),
      problem_(mesh.X(), mesh.topology(), mesh.fixed(), options_),
      largest_rate_(problem_.jacobian().largest_rate(mesh.X())),
      J_(problem_.jacobian().rows_at(mesh.X(), 2 / largest_rate_)),
      functions_(J_, problem_.jacobian().metric(), largest_rate_) {}

std::vector<double> LinearSmoother::series_for(int steps) const {
  const auto taken = [&](double rate) {
    return 1 - std::pow(1 + options_.total_time * rate / steps, -steps);
  };
  return chebyshev_series(taken, largest_rate_,
                          can_factor_ ? choice_tuning.cutoff.most_terms : unlimited);
}

bool LinearSmoother::linearise(int steps) {
  try {
    linearise_flow(problem_, options_.total_time, steps, choice_tuning.cutoff.tolerance);
  } catch (const OutOfMemory&) {
    can_factor_ = false;
  }
  return can_factor_;
}

Points LinearSmoother::smooth(double cutoff) {
  const Topology& topology = mesh_.topology();
  options_.total_time = time_in_flow_units(time_for_cutoff(cutoff), mesh_.X(), topology, options_);
  require_usable(mesh_.X(), mesh_.fixed(), options_);
  Points X = mesh_.X();
  X(unknowns_.vertex, Eigen::all) -= taken_of_mesh();
  for (int pass = 0; pass < options_.twicing; ++pass) {
    const Points normals = unknown_normals(X, topology, unknowns_);
    Points heights = Points::Zero(unknowns_.size(), 3);
    heights.col(0) = heights_along(normals, mesh_.X(), X, unknowns_);
    heights = kept_of(heights, options_.twicing_steps());
    X(unknowns_.vertex, Eigen::all) += heights.col(0).asDiagonal() * normals;
  }
  return X;
}

Points LinearSmoother::taken_of(const Points& noise) {
  Points taken = noise - kept_of(noise, options_.steps);
  for (int pass = 0; pass < options_.twicing; ++pass) {
    taken -= kept_of(taken, options_.twicing_steps());
  }
  return taken;
}

Points LinearSmoother::taken_of_mesh() {
  const Eigen::VectorXd& D = problem_.jacobian().metric();
  const auto series = series_for(options_.steps);
  if (!series.empty()) {
    return functions_.apply_integrated(series, D.cwiseInverse().asDiagonal() * problem_.gradient());
  }
  if (!linearise(options_.steps)) {
    return taken_of_mesh();
  }
  Points move, next, taken;
  problem_.jacobian().solve(problem_.jacobian().time_step() * problem_.gradient(), move);
  taken = move;
  for (int step = 1; step < options_.steps; ++step) {
    next = move;
    problem_.jacobian().solve(D.asDiagonal() * move, next);
    move.swap(next);
    taken += move;
  }
  return taken;
}

Points LinearSmoother::kept_of(const Points& b, int steps) {
  const auto series = series_for(steps);
  if (!series.empty()) {
    return b - functions_.apply(series, b);
  }
  if (!linearise(steps)) {
    return kept_of(b, steps);
  }
  Points kept = b;
  flow_linearly(problem_, steps, kept);
  return kept;
}

}  // namespace ibmfair
