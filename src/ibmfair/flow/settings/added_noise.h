// The risk of a flow (the mean squared distance that it leaves to the true shape), estimated from
// the noisy mesh alone for any flow, as rough as it may be.
//
// Let y = x + e be the noisy heights of the vertices, with e of standard deviation s, and let z be
// white noise. The flow F runs from y + a s z. Given that sum of the two noises, each of them is
// expected to be its share of the sum, so that <F - x, e> is expected to be <F - x, s z> / a. So
//
//   risk = |F - y|^2 / n + 2 <F - r, s z> / (a n) - s^2,
//
// with any r that does not depend on z in place of x, is unbiased for the flow of a mesh with noise
// of s (1 + a^2)^0.5: N. Oliveira, J. Lei, R. J. Tibshirani, "Unbiased risk estimation in the
// normal means problem via coupled bootstrap techniques" (2021); T. Pang, H. Zheng, Y. Quan, H. Ji,
// "Recorrupted-to-recorrupted" (CVPR 2021). Derivatives of F, which Stein's formula needs
// (flow/settings/cutoff_trials.h), do not exist where hinges become creases. The mean over z and -z
// does not depend on r, and scatters little. All flows of one object share z, so that their risks
// compare better than each is known.
#pragma once

#include <cstddef>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/energy/unknowns.h"
#include "ibmfair/flow/settings/trial_mesh.h"

namespace ibmfair {

class AddedNoise {
 public:
  /// `mesh` must outlive this object. `noise`: its standard deviation along the normals, length.
  /// Throws BadMesh if no counted vertex moves.
  AddedNoise(const TrialMesh& mesh, double noise);

  /// The risk, length^2, of a flow with these options to this cut-off (length). Their total time is
  /// not used, and only a few of their steps are made. May be negative by chance. Deterministic.
  /// Throws the exceptions of the flow.
  double risk(FlowOptions options, double cutoff) const;

  /// The number of vertices over which risks are means.
  std::size_t counted() const { return counted_.size(); }

 private:
  Eigen::VectorXd heights(const Points& Y, const Points& over) const;

  const TrialMesh& mesh_;
  const double noise_;
  Unknowns unknowns_;
  std::vector<Index> counted_;  // unknowns whose vertices are counted
  Points normals_;              // #unknowns x 3, of the mesh with filtered normals
  Points noisier_;              // #V x 3, with the noise added
  Eigen::VectorXd added_;       // heights of the noise added
};

}  // namespace ibmfair
