#include "ibmfair/flow/cutoff_choice.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/random_numbers.h"
#include "ibmfair/flow/flow_problem.h"
#include "ibmfair/flow/linear_flow.h"
#include "ibmfair/flow/local_mesh.h"
#include "ibmfair/flow/time_scale.h"
#include "ibmfair/flow/twicing.h"
#include "ibmfair/flow/unknown_normals.h"
#include "ibmfair/flow/willmore_flow.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

constexpr double first_edges = 2;       // the shortest cut-off, in mean edge lengths
constexpr std::size_t noise_trial = 1;  // by which noise is told: shapes have little in it yet
constexpr double clear_rise = 0.1;      // of the risk over the least, in variances of the noise
constexpr double small_gain = 0.002;    // of it by twice the cut-off, in these

double median(Eigen::VectorXd values) {
  double* const middle = values.data() + values.size() / 2;
  std::nth_element(values.data(), middle, values.data() + values.size());
  return *middle;
}

/// White noise, #unknowns x 3: three at once take little longer to smooth than one.
Points white_noise(Index count) {
  RandomNumbers random(1);
  Points z(count, 3);
  for (double& number : z.reshaped()) {
    number = random.normal();
  }
  return z;
}

/// What the linearised flow at the problem's state, with twicing, makes of heights over it.
Points smooth_linearly(FlowProblem& p, const Points& heights) {
  Points smooth = heights, rest;
  linearise_flow(p, p.options.steps);
  flow_linearly(p, p.options.steps, smooth);
  if (p.options.twicing > 0) {
    linearise_flow(p, twicing_steps);
  }
  for (int pass = 0; pass < p.options.twicing; ++pass) {
    rest = heights - smooth;
    flow_linearly(p, twicing_steps, rest);
    smooth += rest;
  }
  return smooth;
}

/// What a flow with one cut-off did.
struct Outcome {
  double cutoff;
  double squared_move;   // along the normals, mean
  double trace;          // tr F / n
  double relative_move;  // median over that of white noise of unit deviation
};

class Trials {
 public:
  Trials(const Points& X, const Topology& topology, const std::vector<std::uint8_t>& held,
         FlowOptions options)
      : X_(X),
        topology_(topology),
        held_(held),
        options_(std::move(options)),
        unknowns_(held),
        noise_(white_noise(unknowns_.size())) {
    if (unknowns_.size() == 0) {
      throw BadMesh("no vertex moves, so that no cut-off can be chosen");
    }
  }

  Outcome run(double cutoff) {
    options_.total_time = time_in_flow_units(time_for_cutoff(cutoff), X_, topology_, options_);
    Points Y = X_;
    willmore_flow(Y, topology_, held_, options_);
    FlowProblem problem(Y, topology_, held_, options_, MeshParts::one());
    const Points move = (Y - X_)(unknowns_.vertex, Eigen::all);
    const Eigen::VectorXd height =
        move.cwiseProduct(unknown_normals(Y, topology_, unknowns_)).rowwise().sum();
    const Points smooth = smooth_linearly(problem, noise_);
    const Eigen::VectorXd taken = (noise_ - smooth).reshaped().cwiseAbs();
    return {cutoff, height.squaredNorm() / static_cast<double>(height.size()),
            noise_.cwiseProduct(smooth).mean(), median(height.cwiseAbs()) / median(taken)};
  }

 private:
  const Points& X_;
  const Topology& topology_;
  const std::vector<std::uint8_t>& held_;
  FlowOptions options_;
  Unknowns unknowns_;
  Points noise_;
};

CutoffTrial at_risk(const Outcome& outcome, double noise) {
  const double variance = noise * noise;
  return {outcome.cutoff, outcome.squared_move + variance * (2 * outcome.trace - 1)};
}

std::size_t least(const std::vector<CutoffTrial>& trials) {
  const auto less = [](const CutoffTrial& a, const CutoffTrial& b) { return a.risk < b.risk; };
  return static_cast<std::size_t>(std::min_element(trials.begin(), trials.end(), less) -
                                  trials.begin());
}

/// Where the parabola through the least risk and those beside it, over the logarithm of the
/// cut-off, is least.
double between(const std::vector<CutoffTrial>& trials, std::size_t i) {
  if (i == 0 || i + 1 == trials.size()) {
    return trials[i].cutoff;
  }
  const double left = trials[i - 1].risk - trials[i].risk;
  const double right = trials[i + 1].risk - trials[i].risk;
  const double shift = left + right > 0 ? (left - right) / (2 * (left + right)) : 0;
  return trials[i].cutoff * std::pow(trials[i + 1].cutoff / trials[i].cutoff, shift);
}

/// Whether longer cut-offs have nothing to gain.
bool is_enough(const std::vector<CutoffTrial>& trials, double noise) {
  const double variance = noise * noise, last = trials.back().risk;
  return last - trials[least(trials)].risk > clear_rise * variance ||
         (trials.size() > 2 &&
          std::abs(trials[trials.size() - 3].risk - last) <= small_gain * variance);
}

CutoffChoice choose(Trials trials, double first, double largest, const TrialObserver& observer) {
  const double factor = std::sqrt(2.0);
  std::vector<Outcome> outcomes;
  CutoffChoice choice;
  for (double cutoff = first;; cutoff *= factor) {
    if (observer) {
      observer(cutoff);
    }
    outcomes.push_back(trials.run(cutoff));
    if (outcomes.size() <= noise_trial) {
      continue;
    }
    choice.noise = outcomes[noise_trial].relative_move;
    choice.trials.clear();
    for (const Outcome& outcome : outcomes) {
      choice.trials.push_back(at_risk(outcome, choice.noise));
    }
    if (is_enough(choice.trials, choice.noise) || factor * cutoff > largest) {
      choice.cutoff = between(choice.trials, least(choice.trials));
      return choice;
    }
  }
}

}  // namespace

CutoffChoice choose_cutoff(const Points& X, const Topology& topology,
                           const std::vector<std::uint8_t>& held, const FlowOptions& options,
                           double largest, const TrialObserver& observer) {
  const double first = first_edges * mean_edge_length(X, topology.E);
  if (!is_scattered(topology)) {
    return choose(Trials(X, topology, held, options), first, largest, observer);
  }
  const LocalMesh local = local_mesh(X, topology, held, options);
  return choose(Trials(local.X, local.topology, local.held, local.options), first, largest,
                observer);
}

}  // namespace ibmfair
