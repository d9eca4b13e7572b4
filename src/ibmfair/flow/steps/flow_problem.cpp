#include "ibmfair/flow/steps/flow_problem.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/parallel.h"
#include "ibmfair/base/stopwatch.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

std::unique_ptr<BendingEnergy> bind_energy(const Topology& topology, const FlowOptions& options,
                                           const std::vector<std::uint8_t>& fixed,
                                           const MeshParts& parts) {
  EnergyOptions energy = options.energy_options();
  energy.active.resize(fixed.size());
  std::ranges::transform(fixed, energy.active.begin(), [](auto flag) { return flag ? 0 : 1; });
  energy.own_vertices = parts.own_vertices();
  energy.own_triangles = parts.own_triangles();
  return bending_model(options.laplacian).create(topology, energy);
}

/// Why an energy, which has powers of lengths up to the fourth in it, is not finite.
std::string cause_of_overflow(const Points& X) {
  const double size = std::pow(bounding_box_size(X).maxCoeff(), 4);
  if (std::isnormal(size)) {
    return "some triangles have hardly any area (`ibmfair info` gives the smallest angle and edge)";
  }
  return size > 0 ? "its edges are too long to compute with; scale the mesh down"
                  : "its edges are too short to compute with; scale the mesh up";
}

}  // namespace

FlowProblem::FlowProblem(const Points& X_start, const Topology& mesh_topology,
                         const std::vector<std::uint8_t>& fixed_vertices,
                         const FlowOptions& flow_options, const MeshParts& mesh_parts)
    : topology(mesh_topology),
      fixed(fixed_vertices),
      options(flow_options),
      parts(mesh_parts),
      unknowns(fixed, parts.own_vertices()),
      X(X_start),
      start_(X_start),
      bound_(start_, flow_options.max_move),
      conserved_(X, topology, unknowns, options),
      rims_(start_, topology, options.guarded ? unknowns : Unknowns()),
      bending_(bind_energy(topology, options, fixed, parts)),
      jacobian_(
          std::make_unique<Jacobian>(start_, *bending_, topology, unknowns, options, report)) {
  if (options.put_back_slides && options.twicing > 0) {
    conserved_.suspend();
  }
  update_gradient();
  if (!std::isfinite(energy_)) {
    throw BadMesh(fmt::format("the bending energy of the mesh is not finite: {}",
                              cause_of_overflow(X_start)));
  }
  report.energy_before = report.energy_after = energy_;
  report.unknowns = count(unknowns.size());
}

double FlowProblem::energy_at(const Points& Y) {
  return parts.sum(bending_->energy(Y));
}

bool FlowProblem::has_no_folds(double energy, double angle) const {
  return std::isfinite(energy) && bending_->max_dihedral_turn() < least_turn(angle);
}

std::vector<Index> FlowProblem::new_folds(const FoldWatch& folds, const Points& Y,
                                          double energy) const {
  if (has_no_folds(energy)) {
    return {};
  }
  return std::isfinite(energy) ? folds.new_folds(Y, bending_->near_turns(least_turn()))
                               : folds.new_folds(Y);
}

void FlowProblem::update_gradient() {
  if (!gradient_is_known_) {
    energy_ = energy_and_gradient_at(X, g_);
  }
  gradient_is_known_ = true;
}

double FlowProblem::try_state(const Points& Y) {
  next_energy_ = evaluate(Y, next_g_);
  return next_energy_;
}

void FlowProblem::move_to(Points& Y) {
  X.swap(Y);
  gradient_is_known_ = false;
}

void FlowProblem::move_to_tried(Points& Y) {
  X.swap(Y);
  g_.swap(next_g_);
  energy_ = next_energy_;
  gradient_is_known_ = true;
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
  if (!rims_.empty()) {
    rims_.find_normals(Y);
    rims_.project(gradient);
  }
  return parts.sum(energy);
}

void FlowProblem::newton_step(Points& step) {
  const double h = jacobian_->time_step();
  const auto solve = [&](const Points& B, Points& Y) { jacobian_->solve(B, Y); };
  scratch_.resize(g_.rows(), 3);
  parallel_for(g_.rows(), [&](std::int64_t u) { scratch_.row(u) = -h * g_.row(u); });
  solve(scratch_, step);  // [W07] (12) at X_k, where the residual is h grad E_b
  keep_rims(step);
  conserved_.linearise(X, solve);
  conserved_.constrain(step);
  Points Y, correction;
  for (int i = 1; i < options.newton_iterations; ++i) {
    displace(step, Y);
    Points residual = jacobian_->metric().asDiagonal() * step + h * gradient_at(Y);
    keep_rims(residual);
    solve(-residual, correction);
    keep_rims(correction);
    conserved_.constrain(correction);
    step += correction;
  }
}

void FlowProblem::keep_rims(Points& rows) {
  if (!rims_.empty()) {
    rims_.find_normals(X);
    rims_.project(rows);
  }
}

Points FlowProblem::resume_quantities() {
  return conserved_.resume(X, [&](const Points& B, Points& Y) { jacobian_->solve(B, Y); });
}

const Points& FlowProblem::with_others(const Points& move) {
  if (parts.is_whole()) {
    return move;
  }
  by_vertex_.resize(X.rows(), 3);
  for (Index u = 0; u < unknowns.size(); ++u) {
    by_vertex_.row(unknowns.vertex[u]) = move.row(u);
  }
  parts.refresh(by_vertex_);
  with_others_.resize(X.rows(), 3);
  for (Eigen::Index v = 0; v < X.rows(); ++v) {
    if (const Index u = unknowns.unknown[v]; u >= 0) {
      with_others_.row(u) = by_vertex_.row(v);
    }
  }
  return with_others_;
}

FlowProblem::Landing FlowProblem::displace(const Points& move, Points& Y) const {
  Y.resize(X.rows(), 3);
  const bool bounded = bound_.bounds();
  const double stopped = parallel_sum(X.rows(), [&](std::int64_t v) {
    const Index u = unknowns.unknown[v];
    const Vec3 from = X.row(v);
    if (u < 0 || u >= unknowns.size()) {
      Y.row(v) = from;
      return 0;
    }
    const Vec3 to = from + move.row(u).transpose();
    const Vec3 reached = bounded ? bound_.within(static_cast<Index>(v), to) : to;
    Y.row(v) = reached;
    return bounded && reached != to ? 1 : 0;
  });
  parts.refresh(Y);
  if (!conserved_.empty() && !conserved_.restore(move, Y)) {
    return Landing::infeasible;
  }
  return parts.sum(stopped) > 0 ? Landing::bounded : Landing::complete;
}

std::vector<Index> FlowProblem::stopped() const {
  std::vector<Index> result;
  for (Index u = 0; bound_.bounds() && u < unknowns.size(); ++u) {
    const Index v = unknowns.vertex[u];
    if (bound_.stops(v, X.row(v), -g_.row(u))) {
      result.push_back(u);
    }
  }
  return result;
}

double FlowProblem::longest(const Points& move) const {
  return parts.max(move.rows() > 0 ? std::sqrt(move.rowwise().squaredNorm().maxCoeff()) : 0);
}

std::int64_t FlowProblem::moved(const Points& move) const {
  return count((move.array() != 0).rowwise().any().count());
}

std::int64_t FlowProblem::count(std::int64_t here) const {
  return static_cast<std::int64_t>(parts.sum(static_cast<double>(here)));
}

double FlowProblem::gradient_norm() {
  const Eigen::VectorXd& D = jacobian_->metric();
  conserved_.speed(g_, D, scratch_);
  return std::sqrt(parts.sum(parallel_sum(
      unknowns.size(), [&](std::int64_t u) { return D[u] * scratch_.row(u).squaredNorm(); })));
}

double FlowProblem::power() {
  const Eigen::VectorXd &D = jacobian_->metric(), &damping = jacobian_->damping();
  conserved_.speed(g_, D, scratch_);
  const auto share = [&](std::int64_t u) -> Eigen::Array2d {
    return D[u] / damping[u] * Eigen::Array2d(1, std::sqrt(scratch_.row(u).norm()));
  };
  const Eigen::Array2d sums =
      parallel_sum(unknowns.size(), Eigen::Array2d(Eigen::Array2d::Zero()), share);
  const double weight = parts.sum(sums[0]), root = parts.sum(sums[1]) / weight;
  return weight * std::pow(root, 4) / static_cast<double>(report.unknowns);
}

}  // namespace ibmfair
