#include "ibmfair/flow/twicing.h"

#include "ibmfair/base/errors.h"
#include "ibmfair/base/parallel.h"
#include "ibmfair/flow/fold_free_move.h"
#include "ibmfair/flow/folds.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

constexpr int linear_steps = 4;     // of backward Euler; more change little
constexpr double tolerance = 1e-3;  // of solves: no later step takes what these leave
constexpr int halvings = 2;         // of what is put back, until the energy is low enough

class Twicing {
 public:
  explicit Twicing(FlowProblem& problem)
      : p_(problem), folds_(problem.X, problem.topology, problem.unknowns) {
    p_.jacobian().damping().setOnes();
  }

  /// False where nothing could be put back.
  bool pass() {
    try {
      p_.jacobian().refactor(p_.X, p_.options.total_time / linear_steps);
    } catch (const FactorizationFailed&) {
      return false;
    }
    p_.jacobian().tighten(tolerance);
    find_residual();
    smooth_residual();
    return put_back();
  }

 private:
  /// The heights (first column) of the start over the state.
  void find_residual() {
    normal_.resize(p_.unknowns.size(), 3);
    height_ = Points::Zero(p_.unknowns.size(), 3);
    parallel_for(p_.unknowns.size(), [&](std::int64_t u) {
      const Index v = p_.unknowns.vertex[u];
      const Vec3 normal =
          p_.topology.twisted[v] ? Vec3(Vec3::Zero()) : double_area_vector_at(v, p_.X, p_.topology);
      const double length = normal.norm();
      normal_.row(u) = length > 0 ? Vec3(normal / length) : Vec3(Vec3::Zero());
      height_(u, 0) = normal_.row(u).dot(p_.start().row(v) - p_.X.row(v));
    });
  }

  void smooth_residual() {
    Points smoother;
    for (int i = 0; i < linear_steps; ++i) {
      p_.jacobian().solve(p_.jacobian().metric().asDiagonal() * height_, smoother);
      height_.swap(smoother);
    }
  }

  bool put_back() {
    Points move = height_.col(0).asDiagonal() * normal_;
    for (int i = 0; i <= halvings; ++i, move /= 2) {
      std::int64_t withheld = 0;
      if (displace_without_folds(p_, folds_, move, Y_, withheld) == FlowProblem::Landing::nowhere) {
        continue;
      }
      if (const double energy = p_.energy_at(Y_); energy <= p_.report.energy_before) {
        p_.report.energy_after = energy;
        p_.move_to(Y_);
        return true;
      }
    }
    return false;
  }

  FlowProblem& p_;
  FoldWatch folds_;
  Points normal_, height_;  // one row per unknown
  Points Y_;                // where the move leads
};

}  // namespace

void twice(FlowProblem& problem) {
  Twicing twicing(problem);
  while (problem.report.twicings < problem.options.twicing && twicing.pass()) {
    ++problem.report.twicings;
  }
}

}  // namespace ibmfair
