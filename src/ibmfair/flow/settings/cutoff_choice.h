// Estimates, from the noisy mesh alone, the cut-off wavelength that removes the most noise and the
// least of the shape: among several cut-offs, the one with the least risk, an estimate of the mean
// squared distance to the true shape (flow/settings/cutoff_trials.h).
//
// If the noise is correlated (flow/settings/noise_kind.h), the risks are those for a model of it
// (flow/settings/noise_model.h). Steps between the slices of a scanner are taken for such noise
// where they cover enough of the surface; in few places they count as detail.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "ibmfair/flow/flow_options.h"
#include "ibmfair/flow/settings/choice_tuning.h"
#include "ibmfair/flow/settings/cutoff_trials.h"
#include "ibmfair/flow/settings/noise_model.h"
#include "ibmfair/flow/settings/sample_of_mesh.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

struct CutoffChoice {
  double cutoff = 0;  ///< length
  NoiseModel noise;
  NoiseKind kind = NoiseKind::independent;
  /// The mixture of white and correlated noise that may be there instead of independent noise, if
  /// creases do not explain what looks like it (crease_choice.h); with a deviation of 0 if none.
  NoiseModel mixed_noise = {};
  double white_noise = 0;           ///< CutoffTrials::white_deviation, length; 0 with creases
  bool looks_white = false;         ///< `is_white` of noise_kind.h; false with creases
  std::vector<CutoffTrial> trials;  ///< with increasing cut-off
  double risk_error = 0;            ///< standard error of their risks, length^2

  const CutoffTrial& best() const;  ///< the trial with the least risk
};

/// Called before each trial.
using TrialObserver = std::function<void(double cutoff)>;

struct CutoffSearch {
  double largest = 0;  ///< the largest cut-off to try, length
  TrialObserver observer = {};
  SampleSize sample = {choice_tuning.cutoff.sample, choice_tuning.cutoff.felt_rings};

  /// Calls the observer, if there is one.
  void tell(double cutoff) const {
    if (observer) {
      observer(cutoff);
    }
  }

  /// If the noise is correlated, the sample is smaller, because the cut-offs are longer.
  SampleSize sample_for(const NoiseModel& noise) const;
};

/// Lets copies of a mesh flow to a sequence of cut-offs from two mean edge lengths upward, the
/// shortest cut-off with a noticeable effect, each longer by the square root of two, up to the
/// largest or until the risk has clearly risen or hardly changes. The chosen cut-off is
/// interpolated around the trial with the least risk. If the options keep creases, the first two
/// flows, without creases, tell the noise, and others around the cut-off with the least risk the
/// rest. Volume and area are not kept. Deterministic. Throws BadMesh if all vertices are fixed, and
/// the exceptions of the flow.
CutoffChoice choose_cutoff(const Points& X, const Topology& topology,
                           const std::vector<std::uint8_t>& fixed, const FlowOptions& options,
                           const CutoffSearch& search);

/// The choice by flows without creases for noise that is known to be correlated.
CutoffChoice choose_cutoff_for(const NoiseModel& noise, const Points& X, const Topology& topology,
                               const std::vector<std::uint8_t>& fixed, const FlowOptions& options,
                               const CutoffSearch& search);

}  // namespace ibmfair
