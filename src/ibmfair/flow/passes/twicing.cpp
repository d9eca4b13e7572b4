#include "ibmfair/flow/passes/twicing.h"

#include <vector>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/stopwatch.h"
#include "ibmfair/flow/passes/linear_flow.h"
#include "ibmfair/flow/steps/guarded_move.h"
#include "ibmfair/flow/steps/unknown_normals.h"

namespace ibmfair {
namespace {

class Twicing {
 public:
  Twicing(FlowProblem& problem, double tolerance)
      : p_(problem),
        tolerance_(tolerance),
        folds_(problem.X, problem.topology),
        guarded_move_(problem, folds_) {
    p_.jacobian().damping().setOnes();
  }

  /// Makes one pass; false if nothing could be added back.
  bool pass() {
    try {
      linearise();
    } catch (const FactorizationFailed&) {
      return false;
    }
    Points move = p_.options.put_back_slides ? smooth_move() : smooth_height();
    const Stopwatch watch(p_.report.seconds.guard);
    return guarded_move_.make(move, p_.report.energy_before);
  }

 private:
  /// Heights are smoothed over the present surface, so that each pass linearises anew; moves are
  /// smoothed by the same linearised flow in all passes.
  void linearise() {
    if (p_.report.twicings == 0 || !p_.options.put_back_slides) {
      linearise_flow(p_, p_.options.total_time, p_.options.twicing_steps(), tolerance_);
    }
  }

  void find_normals() {
    normals_ = unknown_normals(p_.X, p_.topology, p_.unknowns);
    for (Index u = 0; u < p_.unknowns.size(); ++u) {
      if (p_.topology.twisted[p_.unknowns.vertex[u]]) {
        normals_.row(u).setZero();
      }
    }
  }

  /// The move from the state to the start, smoothed by the linearised flow.
  Points smooth_move() {
    const std::vector<Index>& free = p_.unknowns.vertex;
    Points move = p_.start()(free, Eigen::all) - p_.X(free, Eigen::all);
    flow_linearly(p_, p_.options.twicing_steps(), move);
    p_.keep_rims(move);
    return move;
  }

  /// The height of the start over the state, smoothed by the linearised flow, along the normals.
  Points smooth_height() {
    find_normals();
    Points heights = Points::Zero(p_.unknowns.size(), 3);
    heights.col(0) = heights_along(normals_, p_.start(), p_.X, p_.unknowns);
    flow_linearly(p_, p_.options.twicing_steps(), heights);
    return heights.col(0).asDiagonal() * normals_;
  }

  FlowProblem& p_;
  double tolerance_;
  FoldWatch folds_;
  GuardedMove guarded_move_;
  Points normals_;  // one row per unknown
};

}  // namespace

void apply_twicing(FlowProblem& problem, double tolerance) {
  Twicing twicing(problem, tolerance);
  while (problem.report.twicings < problem.options.twicing && twicing.pass()) {
    ++problem.report.twicings;
  }
}

}  // namespace ibmfair
