// Trials by the flow itself.
#pragma once

#include <optional>

#include "ibmfair/base/compressed_rows.h"
#include "ibmfair/flow/settings/trial_smoother.h"
#include "ibmfair/flow/steps/flow_problem.h"

namespace ibmfair {

/// Each flow continues from the end of the previous flow: of the time of a cut-off, three quarters
/// come after the end of the cut-off that is shorter by the square root of two. Flows of few steps
/// start anew, because backward Euler with long steps gives another result than with short steps.
class FlowSmoother final : public TrialSmoother {
 public:
  FlowSmoother(const TrialMesh& mesh, const Unknowns& unknowns);

  Points smooth(double cutoff) override;
  Points taken_of(const Points& noise) override;

 private:
  void flow_to(double cutoff);

  const TrialMesh& mesh_;
  const Topology& topology_;
  const CompressedRows rings_;
  FlowOptions options_;   // of a flow from the start to the cut-off
  FlowOptions leg_;       // of the flow from the previous cut-off to this one
  Points state_;          // the mesh after the flow to the last cut-off
  Points smooth_noise_;   // the noise after the linearised flow, or empty before the first
  double time_ = 0;       // flow time of the state
  bool goes_on_ = false;  // the last flow has continued the one before
  std::optional<FlowProblem> problem_;  // at the end of the last flow, with twicing
};

}  // namespace ibmfair
