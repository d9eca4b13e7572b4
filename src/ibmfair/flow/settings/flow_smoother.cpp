#include "ibmfair/flow/settings/flow_smoother.h"

#include <utility>

#include "ibmfair/flow/flow_passes.h"
#include "ibmfair/flow/passes/linear_flow.h"
#include "ibmfair/flow/passes/twicing.h"
#include "ibmfair/flow/settings/choice_tuning.h"
#include "ibmfair/flow/time_scale.h"

namespace ibmfair {

FlowSmoother::FlowSmoother(const TrialMesh& mesh, const Unknowns& /*unknowns*/)
    : mesh_(mesh),
      topology_(mesh.topology()),
      rings_(mesh.options().guarded ? vertex_rings(topology_) : CompressedRows()),
      options_(mesh.options()),
      leg_(mesh.options()) {
  leg_.twicing = 0;
  options_.sharp_angle = leg_.sharp_angle = 0;
}

Points FlowSmoother::smooth(double cutoff) {
  flow_to(cutoff);
  problem_.emplace(mesh_.X(), topology_, mesh_.fixed(), options_);
  Points state = state_;
  problem_->move_to(state);
  if (options_.twicing > 0) {
    apply_twicing(*problem_, choice_tuning.cutoff.tolerance);
  }
  return problem_->X;
}

void FlowSmoother::flow_to(double cutoff) {
  options_.total_time = time_in_flow_units(time_for_cutoff(cutoff), mesh_.X(), topology_, options_);
  goes_on_ = time_ > 0 && options_.steps > choice_tuning.cutoff.leg_steps;
  leg_.total_time = options_.total_time - (goes_on_ ? time_ : 0);
  leg_.steps = goes_on_ ? choice_tuning.cutoff.leg_steps : options_.steps;
  if (!goes_on_) {
    state_ = mesh_.X();
  }
  require_usable(state_, mesh_.fixed(), leg_);
  FlowProblem problem(state_, topology_, mesh_.fixed(), leg_);
  run_time_steps(problem, rings_);
  state_ = std::move(problem.X);
  time_ = options_.total_time;
}

Points FlowSmoother::taken_of(const Points& noise) {
  if (!goes_on_ || smooth_noise_.size() == 0) {
    smooth_noise_ = noise;
  }
  linearise_flow(*problem_, leg_.total_time, leg_.steps, choice_tuning.cutoff.tolerance);
  flow_linearly(*problem_, leg_.steps, smooth_noise_);
  Points taken = noise - smooth_noise_, rest;
  if (options_.twicing > 0) {
    linearise_flow(*problem_, options_.total_time, options_.twicing_steps(),
                   choice_tuning.cutoff.tolerance);
  }
  for (int pass = 0; pass < options_.twicing; ++pass) {
    rest = taken;
    flow_linearly(*problem_, options_.twicing_steps(), rest);
    taken -= rest;
  }
  return taken;
}

}  // namespace ibmfair
