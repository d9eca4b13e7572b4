#include "ibmfair/flow/cutoff_choice.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/random_numbers.h"
#include "ibmfair/flow/flow_problem.h"
#include "ibmfair/flow/linear_flow.h"
#include "ibmfair/flow/local_mesh.h"
#include "ibmfair/flow/sample_of_mesh.h"
#include "ibmfair/flow/time_scale.h"
#include "ibmfair/flow/twicing.h"
#include "ibmfair/flow/unknown_normals.h"
#include "ibmfair/flow/willmore_flow.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/mesh/select.h"

namespace ibmfair {
namespace {

constexpr double first_edges = 2;       // the shortest cut-off, in mean edge lengths
constexpr std::size_t noise_trial = 1;  // by which noise is told: shapes have little in it yet
constexpr double clear_rise = 0.03;     // of the risk over the least, in variances of the noise
constexpr double small_gain = 0.002;    // of it by twice the cut-off, in these
constexpr int leg_steps = 4;            // of backward Euler from one cut-off to the next
constexpr double law_edges = 8;         // cut-off in mean edge lengths, for Weyl's law
constexpr double many_more = 1.5;       // vertices than are enough, for a sample to pay

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

/// What a flow with one cut-off did.
struct Outcome {
  double cutoff;
  double squared_move;  // along the normals, mean
  double trace;         // tr F / n
};

/// Flows with longer and longer cut-offs. Each goes on where the last one ended, but for those of
/// few steps, which begin anew: long steps of backward Euler are not what shorter ones come to.
class Trials {
 public:
  /// Only what becomes of `counted` vertices is looked at (#V, or empty for all).
  Trials(const Points& X, const Topology& topology, const std::vector<std::uint8_t>& held,
         const FlowOptions& options, const std::vector<std::uint8_t>& counted)
      : X_(X),
        topology_(topology),
        held_(held),
        law_holds_from_(law_edges * mean_edge_length(X, topology.E)),
        options_(options),
        leg_(options),
        unknowns_(held),
        counted_(indices_where(
            unknowns_.size(),
            [&](Index u) { return counted.empty() || counted[unknowns_.vertex[u]] != 0; })),
        white_noise_(white_noise(unknowns_.size())) {
    if (counted_.empty()) {
      throw BadMesh("no vertex moves, so that no cut-off can be chosen");
    }
    leg_.twicing = 0;
  }

  void run(double cutoff) {
    flow_to(cutoff);
    FlowProblem problem(X_, topology_, held_, options_, MeshParts::one());
    Points state = Y_;
    problem.move_to(state);
    if (options_.twicing > 0) {
      twice(problem);
    }
    Points taken;  // of white noise
    double trace = 0;
    if (trace_falls_) {
      trace = trace_by_law(cutoff);
    } else {
      taken = taken_of_noise(problem)(counted_, Eigen::all);
      const Points noise = white_noise_(counted_, Eigen::all);
      trace = 1 - noise.cwiseProduct(taken).sum() / noise.squaredNorm();
    }
    const Points normals = unknown_normals(problem.X, topology_, unknowns_);
    const Eigen::VectorXd height = heights_along(normals, problem.X, X_, unknowns_)(counted_);
    if (outcomes_.size() == noise_trial) {
      noise_ = median(height.cwiseAbs()) / median(taken.reshaped().cwiseAbs());
    }
    trace_falls_ = trace_falls_ || falls_by_law(cutoff, trace);
    outcomes_.push_back({cutoff, height.squaredNorm() / static_cast<double>(height.size()), trace});
  }

  bool tell_noise() const { return outcomes_.size() > noise_trial; }

  /// Standard deviation, as soon as they tell it.
  double noise() const { return noise_; }

  std::vector<CutoffTrial> risks() const {
    const double variance = noise_ * noise_;
    std::vector<CutoffTrial> risks;
    for (const Outcome& o : outcomes_) {
      risks.push_back({o.cutoff, o.squared_move + variance * (2 * o.trace - 1)});
    }
    return risks;
  }

 private:
  void flow_to(double cutoff) {
    options_.total_time = time_in_flow_units(time_for_cutoff(cutoff), X_, topology_, options_);
    const bool goes_on = !outcomes_.empty() && options_.steps > leg_steps;
    if (!goes_on) {
      Y_ = X_;
      smooth_ = white_noise_;
    }
    leg_.total_time = options_.total_time - (goes_on ? time_ : 0);
    leg_.steps = goes_on ? leg_steps : options_.steps;
    willmore_flow(Y_, topology_, held_, leg_);
    time_ = options_.total_time;
  }

  /// By the linearised flow at the problem's state, with twicing.
  Points taken_of_noise(FlowProblem& problem) {
    linearise_flow(problem, leg_.total_time, leg_.steps);
    flow_linearly(problem, leg_.steps, smooth_);
    Points taken = white_noise_ - smooth_, rest;
    if (options_.twicing > 0) {
      linearise_flow(problem, options_.total_time, twicing_steps);
    }
    for (int pass = 0; pass < options_.twicing; ++pass) {
      rest = taken;
      flow_linearly(problem, twicing_steps, rest);
      taken -= rest;
    }
    return taken;
  }

  /// From the last outcome, by H. Weyl's law of the number of modes on a surface, which holds as
  /// soon as the edges are short beside the cut-off.
  double trace_by_law(double cutoff) const {
    const Outcome& last = outcomes_.back();
    return last.trace * std::pow(last.cutoff / cutoff, 2);
  }

  bool falls_by_law(double cutoff, double trace) const {
    constexpr double near = 0.15;
    return !outcomes_.empty() && cutoff >= law_holds_from_ &&
           std::abs(trace - trace_by_law(cutoff)) < near * trace;
  }

  const Points& X_;
  const Topology& topology_;
  const std::vector<std::uint8_t>& held_;
  const double law_holds_from_;  // cut-off, or a longer one
  FlowOptions options_;          // to the cut-off
  FlowOptions leg_;              // from the one before to it
  Unknowns unknowns_;
  std::vector<Index> counted_;  // among the unknowns
  Points white_noise_;
  Points Y_, smooth_;  // where the mesh and the white noise have come to
  double time_ = 0;    // at which they are there
  std::vector<Outcome> outcomes_;
  bool trace_falls_ = false;  // by the law
  double noise_ = 0;
};

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
  for (double cutoff = first;; cutoff *= factor) {
    if (observer) {
      observer(cutoff);
    }
    trials.run(cutoff);
    if (!trials.tell_noise()) {
      continue;
    }
    CutoffChoice choice{.noise = trials.noise(), .trials = trials.risks()};
    if (is_enough(choice.trials, choice.noise) || factor * cutoff > largest) {
      choice.cutoff = between(choice.trials, least(choice.trials));
      return choice;
    }
  }
}

}  // namespace

CutoffChoice choose_cutoff(const Points& X, const Topology& topology,
                           const std::vector<std::uint8_t>& held, const FlowOptions& options,
                           double largest, const TrialObserver& observer, Index enough) {
  const double first = first_edges * mean_edge_length(X, topology.E);
  const auto choose_on = [&](const LocalMesh& mesh, const std::vector<std::uint8_t>& counted) {
    return choose(Trials(mesh.X, mesh.topology, mesh.held, mesh.options, counted), first, largest,
                  observer);
  };
  FlowOptions unbound = options;
  unbound.keep_volume = unbound.keep_area = false;
  if (std::count(held.begin(), held.end(), 0) > many_more * enough) {
    const MeshSample sample = sample_of_mesh(X, topology, held, unbound, enough);
    // Not of a mesh in pieces so small that they are little but rim.
    if (4 * std::count(sample.inner.begin(), sample.inner.end(), 1) > enough) {
      return choose_on(sample.mesh, sample.inner);
    }
  }
  if (is_scattered(topology)) {
    return choose_on(local_mesh(X, topology, held, unbound), {});
  }
  return choose(Trials(X, topology, held, unbound, {}), first, largest, observer);
}

}  // namespace ibmfair
