#include "ibmfair/flow/steps/stationary_flow.h"

#include <algorithm>
#include <cmath>

#include "ibmfair/base/errors.h"
#include "ibmfair/flow/steps/unknown_normals.h"
#include "ibmfair/flow/tuning.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
StationaryFlow::StationaryFlow(const Points& X, const Topology& topology,
                               const std::vector<std::uint8_t>& fixed, const FlowOptions& options,
                               double h, double h_limit, bool normal_only)
    : problem_(X, topology, fixed, options),
      rings_(vertex_rings(topology)),
      folds_(X, topology),
      h_(h),
      h_limit_(h_limit),
      normal_only_(normal_only) {
  restart();
}

/// With `normal_only`, removes the tangential part, which would only move vertices within the
/// surface.
void StationaryFlow::project(Points& field) const {
  if (normal_only_) {
    const Eigen::VectorXd along = field.cwiseProduct(normals_).rowwise().sum();
    field = along.asDiagonal() * normals_;
  }
}

void StationaryFlow::restart() {
  energy_ = problem_.energy_and_gradient_at(problem_.X, g_);
  normals_ = unknown_normals(problem_.X, problem_.topology, problem_.unknowns);
  project(g_);
  pairs_.forget();
}

void StationaryFlow::move_to(Points& X) {
  problem_.X.swap(X);
  restart();
}

double StationaryFlow::normal_gradient() const {
  const PerVertex mass = lumped_vertex_mass(problem_.X, problem_.topology);
  const Eigen::VectorXd slope = g_.cwiseProduct(normals_).rowwise().sum();
  return std::sqrt(slope.cwiseAbs2().cwiseQuotient(mass(problem_.unknowns.vertex)).sum());
}

bool StationaryFlow::renew() {
  pairs_.forget();
  try {
    problem_.jacobian().refactor(problem_.X, h_);
  } catch (const FactorizationFailed&) {
    h_ /= tuning.stationary.leap;
    return false;
  }
  edge_length_ = local_edge_length(problem_.X, rings_)(problem_.unknowns.vertex);
  stale_ = false;
  steps_with_jacobian_ = 0;
  return true;
}

bool StationaryFlow::advance() {
  for (int attempt = 0; attempt < tuning.stationary.most_attempts; ++attempt) {
    const bool fresh = stale_;
    if (fresh && !renew()) {
      continue;
    }
    const Points step = pairs_.direction(g_, [&](const Points& q) { return solve(q); });
    if (search(step)) {
      return true;
    }
    if (fresh) {
      h_ /= tuning.stationary.leap;
    }
    stale_ = true;
  }
  return false;
}

Points StationaryFlow::solve(const Points& q) {
  if (!normal_only_) {
    Points d;
    problem_.jacobian().solve(h_ * q, d);
    return d;
  }
  const Eigen::VectorXd along = h_ * q.cwiseProduct(normals_).rowwise().sum();
  return problem_.jacobian().solve(along).asDiagonal() * normals_;
}

bool StationaryFlow::search(const Points& step) {
  const double slope = -g_.cwiseProduct(step).sum();
  const Eigen::VectorXd along = step.cwiseProduct(normals_).rowwise().sum();
  const double move =
      along.size() > 0 ? along.cwiseAbs().cwiseQuotient(edge_length_).maxCoeff() : 0;
  Points Y, gradient;
  double fraction = std::min(1.0, tuning.stationary.longest_move / move);
  for (int i = 0; i <= tuning.guard.most_halvings; ++i, fraction /= 2) {
    problem_.displace(fraction * step, Y);
    const double trial = problem_.energy_and_gradient_at(Y, gradient);
    const double predicted = (fraction - fraction * fraction / 2) * slope;
    const double ratio = (energy_ - trial) / std::min(predicted, energy_);
    if (ratio >= tuning.guard.least_decrease && problem_.new_folds(folds_, Y, trial).empty()) {
      last_move_ = fraction * move;
      accept(fraction * step, Y, gradient, trial);
      adapt(fraction, ratio);
      return true;
    }
  }
  return false;
}

void StationaryFlow::accept(const Points& step, Points& Y, Points& gradient, double energy) {
  problem_.X.swap(Y);
  energy_ = energy;
  normals_ = unknown_normals(problem_.X, problem_.topology, problem_.unknowns);
  project(gradient);
  pairs_.add(step, gradient - g_);
  g_.swap(gradient);
}

/// Below its limit the time step grows, and the Jacobian is renewed at each step. At the limit the
/// Jacobian is kept for several steps, and curvature pairs make up for its age.
void StationaryFlow::adapt(double fraction, double ratio) {
  if (fraction < 1 || ++steps_with_jacobian_ >= tuning.stationary.most_steps) {
    stale_ = true;
  } else if (ratio > tuning.guard.good_decrease && h_ < h_limit_) {
    h_ = std::min(h_limit_, h_ * tuning.stationary.leap);
    stale_ = true;
  }
}

}  // namespace ibmfair
