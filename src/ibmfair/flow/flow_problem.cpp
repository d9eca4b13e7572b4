#include "ibmfair/flow/flow_problem.h"

#include <cmath>
#include <limits>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/parallel.h"
#include "ibmfair/base/stopwatch.h"

namespace ibmfair {
namespace {

std::vector<std::uint8_t> opposite(const std::vector<std::uint8_t>& flags) {
  std::vector<std::uint8_t> result(flags.size());
  for (std::size_t i = 0; i < flags.size(); ++i) {
    result[i] = flags[i] ? 0 : 1;
  }
  return result;
}

/// The point of the closed ball that lies in the direction of p.
Vec3 within_ball(const Vec3& centre, double radius, const Vec3& p) {
  Vec3 offset = p - centre;
  // Rounding may leave the scaled point outside by a digit; the bound is a promise.
  for (double room = 1; (centre + offset - centre).norm() > radius;
       room -= std::numeric_limits<double>::epsilon()) {
    offset *= room * radius / offset.norm();
  }
  return centre + offset;
}

}  // namespace

FlowProblem::FlowProblem(const Points& X_start, const Topology& mesh_topology,
                         const std::vector<std::uint8_t>& held, const FlowOptions& flow_options)
    : topology(mesh_topology),
      options(flow_options),
      unknowns(held),
      X(X_start),
      start_(X_start),
      bending_(
          bending_model(flow_options.laplacian)
              .bind(mesh_topology, {flow_options.mass, opposite(held), flow_options.mass_matrix})),
      jacobian_(std::make_unique<Jacobian>(*bending_, topology, unknowns, options, report)) {
  energy_ = energy_at(X);
  if (!std::isfinite(energy_)) {
    throw BadMesh("the bending energy of the mesh is not finite: coordinates are too large");
  }
  report.energy_before = report.energy_after = energy_;
  report.unknowns = unknowns.size();
}

double FlowProblem::energy_at(const Points& Y) {
  return bending_->energy(Y);
}

void FlowProblem::update_gradient() {
  if (!gradient_is_new_) {
    energy_ = energy_and_gradient_at(X, g_);
  }
  gradient_is_new_ = false;
}

double FlowProblem::try_state(const Points& Y) {
  next_energy_ = evaluate(Y, next_g_);
  return next_energy_;
}

void FlowProblem::move_to_tried(Points& Y) {
  X.swap(Y);
  g_.swap(next_g_);
  energy_ = next_energy_;
  gradient_is_new_ = true;
}

Points FlowProblem::gradient_at(const Points& Y) {
  Points gradient;
  energy_and_gradient_at(Y, gradient);
  return gradient;
}

double FlowProblem::energy_and_gradient_at(const Points& Y, Points& gradient) {
  const Stopwatch watch(report.seconds.gradient);
  return evaluate(Y, gradient);
}

double FlowProblem::evaluate(const Points& Y, Points& gradient) {
  const double energy = bending_->energy_and_gradient(Y, G_);
  gradient.resize(unknowns.size(), 3);
  parallel_for(unknowns.size(),
               [&](std::int64_t u) { gradient.row(u) = G_.row(unknowns.vertex[u]); });
  return energy;
}

Points FlowProblem::newton_step() {
  const double h = jacobian_->time_step();
  Points step;
  jacobian_->solve(-h * g_, step);  // [W07] (12) at X_k, where the residual is h grad E_b
  Points Y, correction;
  for (int i = 1; i < options.newton_iterations; ++i) {
    displace(step, Y);
    const Points residual = jacobian_->metric().asDiagonal() * step + h * gradient_at(Y);
    jacobian_->solve(-residual, correction);
    step += correction;
  }
  return step;
}

void FlowProblem::displace(const Points& move, Points& Y) const {
  Y.resize(X.rows(), 3);
  const bool bounded = options.max_move < std::numeric_limits<double>::infinity();
  parallel_for(X.rows(), [&](std::int64_t v) {
    Y.row(v) = X.row(v);
    if (const Index u = unknowns.unknown[v]; u >= 0) {
      Y.row(v) += move.row(u);
      if (bounded) {
        Y.row(v) = within_ball(start_.row(v), options.max_move, Y.row(v));
      }
    }
  });
}

double FlowProblem::gradient_norm() const {
  return std::sqrt(g_.rowwise().squaredNorm().cwiseQuotient(jacobian_->metric()).sum());
}

}  // namespace ibmfair
