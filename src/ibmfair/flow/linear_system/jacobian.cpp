#include "ibmfair/flow/linear_system/jacobian.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/parallel.h"
#include "ibmfair/base/stopwatch.h"
#include "ibmfair/energy/mass_matrices.h"
#include "ibmfair/flow/tuning.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
Jacobian::Jacobian(const Points& start, BendingEnergy& energy, const Topology& topology,
                   const Unknowns& unknowns, const FlowOptions& options, FlowReport& report)
    : start_(start),
      energy_(energy),
      topology_(topology),
      terms_(energy.stencils(), topology.vertex_count),
      unknowns_(unknowns),
      options_(options),
      report_(report),
      D_(Eigen::VectorXd::Ones(unknowns.size())),
      damping_(D_) {}

void Jacobian::update_metric(const Points& X) {
  const bool by_valence = options_.counts_valence();
  const bool by_mass = !by_valence && options_.metric == Metric::mass;
  const PerVertex mass = by_mass ? lumped_vertex_mass(X, topology_) : PerVertex();
  parallel_for(unknowns_.size(), [&](std::int64_t u) {
    const Index v = unknowns_.vertex[u];
    double D = by_mass ? mass[v] : 1;
    if (by_valence) {
      D = static_cast<double>(std::max<std::size_t>(1, topology_.stars[v].size())) /
          regular_valence;
    }
    if (options_.cutoff_factor.size() > 0) {
      D /= std::pow(options_.cutoff_factor[v], 4);
    }
    D_[u] = D * damping_[u];
  });
}

JacobianParts Jacobian::linearise(const Points& X, double h) {
  const Stopwatch watch(report_.seconds.assemble);
  update_metric(X);
  energy_.linearise(X, weights_);
  return {weights_, D_, h};
}

JacobianShape Jacobian::shape() const {
  return {start_, terms_, unknowns_, options_, report_};
}

void Jacobian::refactor(const Points& X, double h) {
  const JacobianParts parts = linearise(X, h);
  if (!solver_) {
    // The first time steps of a guarded flow are short; the backend is chosen for the later ones.
    choose_solver({weights_, D_, std::max(h, options_.total_time / options_.steps)});
  }
  h_ = 0;
  try {
    solver_->update(parts);
  } catch (const FactorizationFailed&) {
    // The flow tries a shorter time step next, with which the factorization may succeed.
    const JacobianBackend* other = !options_.make_solver && ++failures_ > tuning.solver.patience
                                       ? other_backend(shape(), false)
                                       : nullptr;
    if (other == nullptr || other->name == report_.solver) {
      throw;
    }
    take(*other);
    settled_ = true;
    solver_->update(parts);
  }
  h_ = h;
  rival_ = settled_ ? nullptr : other_backend(shape(), true);
  if (rival_ != nullptr) {
    iterations_ = forecast_iterations(shape(), parts);
  } else {
    weights_ = StencilWeights();  // frees memory: the solver has its own copy of what it needs
  }
}

void Jacobian::choose_solver(const JacobianParts& parts) {
  if (options_.make_solver) {
    solver_ = options_.make_solver(shape());
    settled_ = true;
  } else {
    const JacobianBackend& backend = choose_backend(shape(), parts);
    take(backend);
    settled_ = backend.has_factor;
  }
}

void Jacobian::take(const JacobianBackend& backend) {
  report_.solver = backend.name;
  solver_ = backend.make(shape());
}

std::vector<BackendForecast> Jacobian::forecasts(const Points& X, double h) {
  const JacobianParts parts = linearise(X, h);
  const IterationForecast iterations = forecast_iterations(shape(), parts);
  std::vector<BackendForecast> result;
  for (const JacobianBackend& backend : jacobian_backends()) {
    result.push_back({backend.name, backend.forecast(shape(), iterations)});
  }
  report_.solver = choose_backend(shape(), parts).name;
  return result;
}

JacobianRows Jacobian::rows_at(const Points& X, double h) {
  linearise(X, h);
  JacobianRows rows(terms_, unknowns_);
  rows.update(weights_, D_, h);
  return rows;
}

double Jacobian::largest_rate(const Points& X) {
  linearise(X, 1);
  double largest = std::numeric_limits<double>::min();
  for (Index u = 0; u < unknowns_.size(); ++u) {
    double sum = 0;
    terms_.for_terms(unknowns_.vertex[u], weights_,
                     [&](Index /*v*/, double term) { sum += std::abs(term); });
    largest = std::max(largest, sum / D_[u]);
  }
  return largest;
}

/// The number of iterations of a solve is hard to predict. If there are so many that a
/// factorization is cheaper for the remaining steps, the rival backend takes over.
void Jacobian::solve(const Points& B, Points& Y) {
  if (rival_ == nullptr) {
    solver_->solve(B, Y);
  } else if (!solve_before_rival(B, Y)) {
    factor_instead();
    solver_->solve(B, Y);
  }
  ++report_.solves;
}

/// Solves within the time that the rival needs for each remaining solve, plus a grace period
/// (SolverTuning::most_grace) for all solves together. False, without a solution, if that time is
/// too short.
bool Jacobian::solve_before_rival(const Points& B, Points& Y) {
  const double all = rival_->forecast(shape(), iterations_).seconds;
  grace_ = std::min(grace_, tuning.solver.most_grace * all);
  double seconds = all / shape().solves_left() + grace_;
  const bool solved = solver_->solve_within(seconds, B, Y);
  grace_ = std::min(grace_, seconds);
  return solved;
}

void Jacobian::factor_instead() {
  const JacobianBackend* rival = std::exchange(rival_, nullptr);
  settled_ = true;
  const std::string last_name = report_.solver;
  std::unique_ptr<JacobianSolver> last = std::move(solver_);
  try {
    take(*rival);
    solver_->update({weights_, D_, h_});
  } catch (const Error&) {  // too thin a triangle, or too little memory
    report_.solver = last_name;
    solver_ = std::move(last);
  }
}

Eigen::VectorXd Jacobian::solve(const Eigen::VectorXd& b) {
  Points B = Points::Zero(b.size(), 3), Y;
  B.col(0) = b;
  solve(B, Y);
  return Y.col(0);
}

}  // namespace ibmfair
