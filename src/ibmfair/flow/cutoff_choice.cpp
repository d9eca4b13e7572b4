#include "ibmfair/flow/cutoff_choice.h"

#include <algorithm>
#include <cmath>

#include "ibmfair/flow/local_mesh.h"
#include "ibmfair/flow/sample_of_mesh.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

constexpr double noise_edges = 2;     // of the first cut-off where the second tells the noise
constexpr double clear_rise = 0.03;   // of the risk over the least, in variances of the noise
constexpr double small_gain = 0.002;  // of risk by twice the cut-off, in these
constexpr double many_more = 1.5;     // vertices than are enough, for a sample to pay

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

/// One mesh to try cut-offs on, and its vertices that count.
struct Subject {
  const Points& X;
  const Topology& topology;
  const std::vector<std::uint8_t>& held;
  const FlowOptions& options;
  const std::vector<std::uint8_t>& counted;
};

template <class Done>
void try_cutoffs(CutoffTrials& trials, double first, const TrialObserver& observer,
                 const Done& done) {
  for (double cutoff = first;; cutoff *= std::sqrt(2.0)) {
    if (observer) {
      observer(cutoff);
    }
    trials.run(cutoff);
    if (trials.tell_noise() && done(std::sqrt(2.0) * cutoff)) {
      return;
    }
  }
}

/// By flows that keep no creases.
double tell_noise(const Subject& s, double first, const TrialObserver& observer) {
  FlowOptions options = s.options;
  options.sharp_angle = 0;
  CutoffTrials trials(s.X, s.topology, s.held, options, s.counted);
  try_cutoffs(trials, first, observer, [](double) { return true; });
  return trials.noise();
}

CutoffChoice choose(const Subject& s, double edge, const CutoffSearch& search) {
  const bool tells_noise_first = search.noise == 0 && s.options.sharp_angle > 0;
  CutoffTrials trials(
      s.X, s.topology, s.held, s.options, s.counted,
      tells_noise_first ? tell_noise(s, noise_edges * edge, search.observer) : search.noise);
  CutoffChoice choice;
  try_cutoffs(trials, search.shortest_edges * edge, search.observer, [&](double next) {
    choice.noise = trials.noise();
    choice.trials = trials.risks();
    return is_enough(choice.trials, choice.noise) || next > search.largest;
  });
  choice.cutoff = between(choice.trials, least(choice.trials));
  return choice;
}

}  // namespace

const CutoffTrial& CutoffChoice::best() const {
  return trials[least(trials)];
}

CutoffChoice choose_cutoff(const Points& X, const Topology& topology,
                           const std::vector<std::uint8_t>& held, const FlowOptions& options,
                           const CutoffSearch& search) {
  const double edge = mean_edge_length(X, topology.E);
  const auto choose_on = [&](const LocalMesh& mesh, const std::vector<std::uint8_t>& counted) {
    return choose({mesh.X, mesh.topology, mesh.held, mesh.options, counted}, edge, search);
  };
  FlowOptions unbound = options;
  unbound.keep_volume = unbound.keep_area = false;
  if (std::count(held.begin(), held.end(), 0) > many_more * search.enough) {
    const MeshSample sample = sample_of_mesh(X, topology, held, unbound, search.enough);
    // Not of a mesh in pieces so small that they are little but rim.
    if (4 * std::count(sample.inner.begin(), sample.inner.end(), 1) > search.enough) {
      return choose_on(sample.mesh, sample.inner);
    }
  }
  if (is_scattered(topology)) {
    return choose_on(local_mesh(X, topology, held, unbound), {});
  }
  return choose({X, topology, held, unbound, {}}, edge, search);
}

}  // namespace ibmfair
