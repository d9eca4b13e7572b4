// The time steps of the guarded flow (flow/willmore_flow.h).
#pragma once

#include "ibmfair/base/compressed_rows.h"
#include "ibmfair/flow/steps/flow_problem.h"
#include "ibmfair/flow/steps/folds.h"

namespace ibmfair {

/// Takes the problem's state through `options.total_time`. `rings`: the result of vertex_rings;
/// `folds` must have been made at the state. Returns the flow time that each unknown has missed
/// where steps were shortened (flow/steps/time_deficit.h).
Eigen::VectorXd run_guarded(FlowProblem& problem, const CompressedRows& rings,
                            const FoldWatch& folds, const StepObserver& observer);

}  // namespace ibmfair
