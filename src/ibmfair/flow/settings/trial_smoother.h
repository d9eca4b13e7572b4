// What a trial of a cut-off needs of a flow: the mesh that it leaves, and what the flow linearised
// there removes from white noise.
#pragma once

#include <memory>

#include "ibmfair/energy/unknowns.h"
#include "ibmfair/flow/settings/trial_mesh.h"

namespace ibmfair {

class TrialSmoother {
 public:
  TrialSmoother() = default;
  TrialSmoother(const TrialSmoother&) = delete;
  TrialSmoother& operator=(const TrialSmoother&) = delete;
  virtual ~TrialSmoother() = default;

  /// The positions, #V x 3, after a flow with twicing to this cut-off (length). Cut-offs must
  /// increase from call to call. Throws the exceptions of the flow.
  virtual Points smooth(double cutoff) = 0;

  /// The part of the noise (one row per unknown) that the flow of the last call removes. May be
  /// left out from some call on, but is then not to be called any more; the noise must be the same
  /// in all calls.
  virtual Points taken_of(const Points& noise) = 0;
};

/// The smoother for the options of the mesh except for its sharp angle: flows (flow_smoother.h), or
/// polynomials if the flow is linear (linear_smoother.h), which take a fraction of the time. `mesh`
/// and `unknowns` must outlive the result.
std::unique_ptr<TrialSmoother> make_trial_smoother(const TrialMesh& mesh, const Unknowns& unknowns);

}  // namespace ibmfair
