// How strong noise is, and over how many rings it is correlated.
//
// The model: white noise, and over it white noise of which the mean over each vertex and its
// neighbours was taken some times, as averaging filters and the correlated pixels of depth cameras
// do. What successive cut-offs remove of such noise is known for every number of times, and what
// they remove of the mesh is compared with it.
#pragma once

#include <cmath>
#include <vector>

#include "ibmfair/flow/settings/noise_kind.h"
#include "ibmfair/flow/settings/trial_mesh.h"

namespace ibmfair {

struct NoiseModel {
  double deviation = 0;    ///< standard deviation along the normals, length
  int rings = 0;           ///< how often means over one ring were taken; 0 for white noise
  double white_share = 0;  ///< of the variance, if `rings` is not 0: of white noise added to it

  bool is_white() const { return rings == 0; }
  double variance() const { return deviation * deviation; }

  /// About how many edges apart heights are still alike: twice the standard deviation of the
  /// weights with which the white noise around a vertex adds up.
  double reach() const { return 2 * std::sqrt(static_cast<double>(rings)); }
};

/// The model that fits the bands of correlated noise best, mixed with white noise only if it does
/// not fit well without; or none, with a deviation of 0, if there are no such bands, if there is
/// next to no noise, or if it may be even detail of the shape: if the model fits poorly, or if
/// bands shorter than these have too little of such strong noise, or far too much. Throws the
/// exceptions of the flow.
NoiseModel fit_noise_model(const TrialMesh& mesh, const std::vector<NoiseBand>& bands);

/// The mixture of white and correlated noise that fits the bands best, by least squares, if they
/// may show one (`bands_of_mixed_noise`) and enough of it is correlated; else none, with a
/// deviation of 0. Throws the exceptions of the flow.
NoiseModel fit_mixed_noise(const TrialMesh& mesh, const std::vector<NoiseBand>& bands);

/// White noise of the standard deviation 1, `count` x 3. Deterministic.
Points white_noise(Index count);

/// Noise of the standard deviation 1 that is correlated as that of the model. `white`: white noise
/// of the standard deviation 1, one row per unknown.
Points noise_like(const NoiseModel& model, const Points& white, const Topology& topology,
                  const Unknowns& unknowns);

}  // namespace ibmfair
