#include "ibmfair/flow/settings/trial_smoother.h"

#include "ibmfair/flow/settings/flow_smoother.h"
#include "ibmfair/flow/settings/linear_smoother.h"

namespace ibmfair {

std::unique_ptr<TrialSmoother> make_trial_smoother(const TrialMesh& mesh,
                                                   const Unknowns& unknowns) {
  if (is_linear(mesh.options())) {
    return std::make_unique<LinearSmoother>(mesh, unknowns);
  }
  return std::make_unique<FlowSmoother>(mesh, unknowns);
}

}  // namespace ibmfair
