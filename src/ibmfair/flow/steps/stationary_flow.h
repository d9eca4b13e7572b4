// The limit of the flow at infinite time: Gauss-Newton iteration on E_b. A finite time step keeps
// the energy from rising.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/flow/flow_options.h"
#include "ibmfair/flow/steps/curvature_pairs.h"
#include "ibmfair/flow/steps/flow_problem.h"
#include "ibmfair/flow/steps/folds.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Seeks a stationary point of E_b over the free vertices of a mesh with fixed connectivity, step
/// by step.
///
/// Each step solves (D + h S(X_ref)) d = -h grad E_b(X) and goes along d as far as the energy
/// decreases sufficiently. h grows toward infinity, where the step is that of Gauss-Newton, while
/// steps reach the predicted decrease, and shrinks when a step fails. S is renewed at X when h has
/// changed, when a step had to be shortened or failed, and after some steps (StationaryTuning).
///
/// With `normal_only` a vertex moves by d_v n_v along its normal n_v, and the same Jacobian acts on
/// the lengths d_v: S is then the squared Laplacian, the leading part of the second variation of
/// the Willmore energy for normal displacements. Restricting S to normal displacements instead,
/// S_uv <n_u, n_v>, would also penalize the change of the normals, which the energy does not do;
/// on a half sphere that takes twice as many steps.
class StationaryFlow {
 public:
  /// `options` chooses the energy; its steps and time are not used. The flow starts at `X` with
  /// time step `h`, which grows up to `h_limit` (both length^4). The topology and the options must
  /// outlive this object.
  StationaryFlow(const Points& X, const Topology& topology, const std::vector<std::uint8_t>& fixed,
                 const FlowOptions& options, double h, double h_limit, bool normal_only);

  /// Takes one step that lowers the energy, in several attempts if necessary. Returns false, and
  /// leaves the state as it was, if no attempt succeeds.
  bool advance();

  /// sqrt(sum <g_v, n_v>^2 / D_v) at the state, in 1/length^2: the norm of the part of the gradient
  /// that changes the surface. Zero at a stationary surface, even if moving vertices within the
  /// surface would still lower the energy.
  double normal_gradient() const;

  /// The state, #V x 3.
  const Points& X() const { return problem_.X; }

  /// Continues from `X`, which may differ from the state in the free vertices; `X` then holds the
  /// old state.
  void move_to(Points& X);

  double energy() const { return energy_; }
  double time_step() const { return h_; }

  /// The largest move of a vertex along its normal in the last step, relative to the mean length of
  /// the edges at the vertex.
  double last_normal_move() const { return last_move_; }

  const FlowReport& report() const { return problem_.report; }

 private:
  void project(Points& field) const;
  void restart();
  bool renew();
  Points solve(const Points& q);
  bool search(const Points& step);
  void accept(const Points& step, Points& Y, Points& gradient, double energy);
  void adapt(double fraction, double ratio);

  FlowProblem problem_;
  const CompressedRows rings_;
  FoldWatch folds_;
  CurvaturePairs pairs_;
  double h_, h_limit_;
  bool normal_only_;
  double energy_ = 0;
  double last_move_ = 0;
  Points g_;                     // the gradient, one row per unknown
  Points normals_;               // one row per unknown
  Eigen::VectorXd edge_length_;  // one entry per unknown, when the Jacobian was last renewed
  bool stale_ = true;
  int steps_with_jacobian_ = 0;
};

}  // namespace ibmfair
