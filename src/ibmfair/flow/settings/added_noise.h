// The risk of a flow (the mean squared distance that it leaves to the true shape, CutoffTrial),
// estimated from the noisy mesh alone for any flow, as rough as it may be.
//
// Let y = x + e be the noisy heights of the vertices, with e of standard deviation s, and let z be
// noise of the standard deviation 1 with the same correlations. The flow F runs from y + a s z.
// Given that sum of the two noises, each of them is expected to be its share of the sum, so that
// <F - x, e> is expected to be <F - x, s z> / a. So
//
//   risk = |F - y|^2 / n + 2 <F - r, s z> / (a n) - s^2,
//
// with any r that does not depend on z in place of x, is unbiased for the flow of a mesh with noise
// of s (1 + a^2)^0.5: N. Oliveira, J. Lei, R. J. Tibshirani, "Unbiased risk estimation in the
// normal means problem via coupled bootstrap techniques" (2021); T. Pang, H. Zheng, Y. Quan, H. Ji,
// "Recorrupted-to-recorrupted" (CVPR 2021). Derivatives of F, which Stein's formula needs
// (flow/settings/cutoff_trials.h), do not exist where hinges become creases. The mean over z and -z
// does not depend on r, and scatters little. The same holds for differences of neighbouring heights
// in place of heights. All flows from one object share z, so that their risks compare better than
// each is known.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "ibmfair/base/compressed_rows.h"
#include "ibmfair/base/types.h"
#include "ibmfair/energy/unknowns.h"
#include "ibmfair/flow/settings/height_differences.h"
#include "ibmfair/flow/settings/noise_model.h"
#include "ibmfair/flow/settings/risk_curve.h"
#include "ibmfair/flow/settings/trial_mesh.h"
#include "ibmfair/flow/steps/flow_problem.h"

namespace ibmfair {

/// The two meshes with more noise, y + a s z and y - a s z.
class AddedNoise {
 public:
  /// `mesh` must outlive this object. `options`: of flows to about this cut-off (length) that are
  /// to start here. Throws BadMesh if no counted vertex moves, and the exceptions of the flow.
  AddedNoise(const TrialMesh& mesh, const NoiseModel& noise, FlowOptions options, double cutoff);

  /// The risks of a flow to this cut-off (length) that ends at these positions (#V x 3) from the
  /// two meshes.
  CutoffTrial trial(double cutoff, const std::array<Points, 2>& ends) const;

  const TrialMesh& mesh() const { return mesh_; }
  /// The result of vertex_rings.
  const CompressedRows& rings() const { return rings_; }
  /// The two meshes, #V x 3 each, and the same after the first stage of a flow (first_stage.h),
  /// which all flows share.
  const std::array<Points, 2>& starts() const { return starts_; }
  const std::array<Points, 2>& after_first_stage() const { return after_first_stage_; }

  /// The number of vertices over which risks are means.
  std::size_t counted() const { return counted_.size(); }

 private:
  Eigen::VectorXd heights(const Points& Y, const Points& over) const;
  double risk(double variance, const Eigen::VectorXd& added,
              const std::array<Eigen::VectorXd, 2>& moves) const;

  const TrialMesh& mesh_;
  const NoiseModel noise_;
  const CompressedRows rings_;
  Unknowns unknowns_;
  std::vector<Index> counted_;  // unknowns whose vertices are counted
  HeightDifferences differences_;
  Points normals_;  // #unknowns x 3, of the mesh with filtered normals
  std::array<Points, 2> starts_, after_first_stage_;
  Eigen::VectorXd added_;   // heights of the noise added
  double slope_share_ = 1;  // of half the mean squared slope of the noise in its variance
};

/// Flows with one set of options from the two meshes to several cut-offs. A flow to a longer
/// cut-off goes on from the last one, unless twicing follows.
class NoisierFlows {
 public:
  /// `noise` must outlive this object. The total time of the options is not used, and only a few of
  /// their steps are made. Throws the exceptions of the flow.
  NoisierFlows(const AddedNoise& noise, const FlowOptions& options);

  /// Flows to this cut-off (length). Throws the exceptions of the flow.
  void flow_to(double cutoff);

  /// Does the same, and returns the risks of the flow to this cut-off (length). Deterministic.
  /// Throws the exceptions of the flow.
  CutoffTrial trial(double cutoff);

 private:
  void flow(FlowProblem& problem, const Points& from, bool goes_on) const;

  const AddedNoise& noise_;
  FlowOptions options_;
  double time_ = 0;  // of the states
  std::array<std::unique_ptr<FlowProblem>, 2> problems_;
};

}  // namespace ibmfair
