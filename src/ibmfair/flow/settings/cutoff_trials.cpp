#include "ibmfair/flow/settings/cutoff_trials.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ibmfair/base/random_numbers.h"
#include "ibmfair/flow/flow_passes.h"
#include "ibmfair/flow/passes/linear_flow.h"
#include "ibmfair/flow/passes/twicing.h"
#include "ibmfair/flow/settings/evenness.h"
#include "ibmfair/flow/steps/flow_problem.h"
#include "ibmfair/flow/steps/unknown_normals.h"
#include "ibmfair/flow/time_scale.h"
#include "ibmfair/flow/tuning.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

double median(Eigen::VectorXd values) {
  double* const middle = values.data() + values.size() / 2;
  std::nth_element(values.data(), middle, values.data() + values.size());
  return *middle;
}

double rms(const Eigen::VectorXd& values) {
  return std::sqrt(values.squaredNorm() / static_cast<double>(values.size()));
}

Points white_noise(Index count) {
  RandomNumbers random(1);
  Points z(count, 3);
  for (double& number : z.reshaped()) {
    number = random.normal();
  }
  return z;
}

}  // namespace

CutoffTrials::CutoffTrials(const TrialMesh& mesh, double noise)
    : mesh_(mesh),
      topology_(mesh.topology()),
      rings_(mesh.options().guarded ? vertex_rings(topology_) : CompressedRows()),
      mean_edge_(mean_edge_length(mesh.X(), topology_.E)),
      options_(mesh.options()),
      leg_(mesh.options()),
      unknowns_(mesh.fixed()),
      counted_(counted_unknowns(mesh, unknowns_)),
      white_noise_(white_noise(unknowns_.size())),
      noise_(noise),
      knows_noise_(noise > 0) {
  leg_.twicing = 0;
  options_.sharp_angle = leg_.sharp_angle = 0;
}

void CutoffTrials::run(double cutoff) {
  flow_to(cutoff);
  FlowProblem problem(mesh_.X(), topology_, mesh_.fixed(), options_);
  end_at(problem);
  const Points normals = unknown_normals(problem.X, topology_, unknowns_);
  Points taken;  // of white noise
  double trace = 0;
  if (trace_falls_) {
    trace = trace_by_law(cutoff);
  } else {
    taken = taken_of_noise(problem)(counted_, Eigen::all);
    const Points noise = white_noise_(counted_, Eigen::all);
    trace = 1 - noise.cwiseProduct(taken).sum() / noise.squaredNorm();
    trace_falls_ = falls_by_law(cutoff, trace);
  }
  const Eigen::VectorXd height = heights_along(normals, problem.X, mesh_.X(), unknowns_)(counted_);
  add_band(cutoff, normals, problem.X, taken);
  if (!knows_noise_ && outcomes_.size() == tuning.cutoff.noise_trial) {
    estimate_noise(height, taken);
  }
  outcomes_.push_back({cutoff, height.squaredNorm() / static_cast<double>(height.size()), trace});
}

/// `taken`: of the counted white noise, or empty if unknown.
void CutoffTrials::add_band(double cutoff, const Points& normals, const Points& end,
                            const Points& taken) {
  const bool first = bands_.empty();
  const Eigen::VectorXd height = heights_along(normals, end, first ? mesh_.X() : end_, unknowns_);
  const Eigen::VectorXd counted = height(counted_);
  const double reach = std::max(tuning.noise.least_reach, tuning.noise.reach * cutoff / mean_edge_);
  NoiseBand band{cutoff, evenness(height.cwiseAbs2(), topology_, unknowns_, counted_,
                                  static_cast<int>(2 * reach))};
  if (taken.size() > 0) {
    const Points last = first ? Points::Zero(taken.rows(), 3) : taken_;
    const Eigen::VectorXd white = (taken - last).reshaped();
    band.by_median = median(counted.cwiseAbs()) / median(white.cwiseAbs()) / mean_edge_;
    band.by_rms = rms(counted) / rms(white) / mean_edge_;
  }
  bands_.push_back(band);
  end_ = end;
  taken_ = taken;
}

/// `height`: the moves of the counted unknowns along the normals.
void CutoffTrials::estimate_noise(const Eigen::VectorXd& height, const Points& taken) {
  const Eigen::VectorXd white = taken.reshaped();
  const double by_median = median(height.cwiseAbs()) / median(white.cwiseAbs());
  const double by_rms = rms(height) / rms(white);
  has_outliers_ = by_rms > tuning.noise.outliers * by_median &&
                  bands_.back().by_rms < tuning.noise.same * bands_.front().by_rms &&
                  std::all_of(bands_.begin(), bands_.end(), [](const NoiseBand& band) {
                    return band.evenness >= tuning.noise.even;
                  });
  noise_ = has_outliers_ ? by_rms : by_median;
  knows_noise_ = true;
}

std::vector<CutoffTrial> CutoffTrials::risks() const {
  const double variance = noise_ * noise_;
  std::vector<CutoffTrial> risks;
  for (const Outcome& o : outcomes_) {
    risks.push_back({o.cutoff, o.squared_move + variance * (2 * o.trace - 1)});
  }
  return risks;
}

void CutoffTrials::flow_to(double cutoff) {
  options_.total_time = time_in_flow_units(time_for_cutoff(cutoff), mesh_.X(), topology_, options_);
  const bool goes_on = !outcomes_.empty() && options_.steps > tuning.cutoff.leg_steps;
  leg_.total_time = options_.total_time - (goes_on ? time_ : 0);
  leg_.steps = goes_on ? tuning.cutoff.leg_steps : options_.steps;
  if (!goes_on) {
    smooth_ = white_noise_;
    state_ = mesh_.X();
  }
  require_usable(state_, mesh_.fixed(), leg_);
  FlowProblem problem(state_, topology_, mesh_.fixed(), leg_);
  run_time_steps(problem, rings_);
  state_ = std::move(problem.X);
  time_ = options_.total_time;
}

/// Makes the problem's state the end of a flow to the cut-off.
void CutoffTrials::end_at(FlowProblem& problem) const {
  Points state = state_;
  problem.move_to(state);
  if (options_.twicing > 0) {
    apply_twicing(problem);
  }
}

/// The part of the white noise that the flow linearised at the problem's state removes, with
/// twicing.
Points CutoffTrials::taken_of_noise(FlowProblem& problem) {
  linearise_flow(problem, leg_.total_time, leg_.steps);
  flow_linearly(problem, leg_.steps, smooth_);
  Points taken = white_noise_ - smooth_, rest;
  if (options_.twicing > 0) {
    linearise_flow(problem, options_.total_time, options_.twicing_steps());
  }
  for (int pass = 0; pass < options_.twicing; ++pass) {
    rest = taken;
    flow_linearly(problem, options_.twicing_steps(), rest);
    taken -= rest;
  }
  return taken;
}

/// tr F / n extrapolated from the last outcome by H. Weyl's law for the number of modes on a
/// surface, which holds if the edges are short compared with the cut-off.
double CutoffTrials::trace_by_law(double cutoff) const {
  const Outcome& last = outcomes_.back();
  return last.trace * std::pow(last.cutoff / cutoff, 2);
}

bool CutoffTrials::falls_by_law(double cutoff, double trace) const {
  return !outcomes_.empty() && cutoff >= tuning.cutoff.law_edges * mean_edge_ &&
         std::abs(trace - trace_by_law(cutoff)) < tuning.cutoff.near_law * trace;
}

}  // namespace ibmfair
