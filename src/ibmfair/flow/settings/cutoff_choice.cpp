#include "ibmfair/flow/settings/cutoff_choice.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ibmfair/flow/settings/sample_of_mesh.h"
#include "ibmfair/flow/tuning.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

std::size_t least(const std::vector<CutoffTrial>& trials) {
  const auto less = [](const CutoffTrial& a, const CutoffTrial& b) { return a.risk < b.risk; };
  return static_cast<std::size_t>(std::min_element(trials.begin(), trials.end(), less) -
                                  trials.begin());
}

/// The cut-off at the minimum of the parabola through the least risk and its two neighbours, over
/// the logarithm of the cut-off. If creases are kept, the risk rises more steeply when creases
/// disappear than it fell before; so the cut-off is shortened by only a part of that shift.
double between(const std::vector<CutoffTrial>& trials, std::size_t i, bool keeps_creases) {
  if (i == 0 || i + 1 == trials.size()) {
    return trials[i].cutoff;
  }
  const double left = trials[i - 1].risk - trials[i].risk;
  const double right = trials[i + 1].risk - trials[i].risk;
  double shift = left + right > 0 ? (left - right) / (2 * (left + right)) : 0;
  if (keeps_creases && shift < 0) {
    shift *= tuning.cutoff.shortened_shift;
  }
  return trials[i].cutoff * std::pow(trials[i + 1].cutoff / trials[i].cutoff, shift);
}

/// Whether longer cut-offs are not expected to reduce the risk.
bool is_enough(const std::vector<CutoffTrial>& trials, double noise, bool keeps_creases) {
  const double variance = noise * noise, last = trials.back().risk;
  const double rise =
      keeps_creases ? tuning.cutoff.clear_rise_with_creases : tuning.cutoff.clear_rise;
  return last - trials[least(trials)].risk > rise * variance ||
         (trials.size() > 2 &&
          std::abs(trials[trials.size() - 3].risk - last) <= tuning.cutoff.small_gain * variance);
}

}  // namespace

const CutoffTrial& CutoffChoice::best() const {
  return trials[least(trials)];
}

double CutoffChoice::before_best() const {
  return trials[std::max<std::size_t>(least(trials), 1) - 1].cutoff;
}

CutoffChooser::CutoffChooser(const Points& X, const Topology& topology,
                             const std::vector<std::uint8_t>& fixed, const FlowOptions& options,
                             CutoffSearch search)
    : mean_edge_length_(ibmfair::mean_edge_length(X, topology.E)), search_(std::move(search)) {
  FlowOptions unbound = options;
  unbound.keep_volume = unbound.keep_area = false;
  if (std::count(fixed.begin(), fixed.end(), 0) > tuning.cutoff.many_more * search_.enough) {
    take_sample(X, topology, fixed, unbound);
  }
  if (!local_ && is_scattered(topology)) {
    local_ = local_mesh(X, topology, fixed, unbound);
  }
  if (local_) {
    trials_.emplace(local_->X, local_->topology, local_->fixed, local_->options, counted_,
                    search_.noise);
  } else {
    trials_.emplace(X, topology, fixed, unbound, counted_, search_.noise);
  }
}

/// Replaces the mesh by a sample, unless the mesh is in so small pieces that the sample would
/// consist mostly of rims.
void CutoffChooser::take_sample(const Points& X, const Topology& topology,
                                const std::vector<std::uint8_t>& fixed,
                                const FlowOptions& options) {
  MeshSample sample = sample_of_mesh(X, topology, fixed, options, search_.enough);
  const auto inner = std::count(sample.inner.begin(), sample.inner.end(), 1);
  if (static_cast<double>(inner) <= tuning.cutoff.least_inner * search_.enough) {
    return;
  }
  if (is_scattered(sample.mesh.topology)) {
    const LocalMesh& s = sample.mesh;
    local_ = local_mesh(s.X, s.topology, s.fixed, s.options);
    for (const Index v : local_->vertex) {
      counted_.push_back(sample.inner[v]);
    }
  } else {
    local_ = std::move(sample.mesh);
    counted_ = std::move(sample.inner);
  }
}

template <class Done>
void CutoffChooser::try_cutoffs(double shortest, const Done& done) {
  for (double cutoff = shortest;; cutoff *= std::sqrt(2.0)) {
    if (search_.observer) {
      search_.observer(cutoff);
    }
    trials_->run(cutoff);
    if (trials_->know_noise() && done(std::sqrt(2.0) * cutoff)) {
      return;
    }
  }
}

/// Whether the next cut-off is to be tried to learn about correlated noise.
bool CutoffChooser::looks_further(double next) const {
  return !trials_->has_outliers() && next <= tuning.noise.longest * mean_edge_length_ &&
         !trials_->bands().empty() && may_tell_more(trials_->bands());
}

CutoffChoice CutoffChooser::choose(double sharp_angle, double shortest) {
  const bool keeps_creases = sharp_angle > 0;
  if (keeps_creases && !trials_->know_noise()) {
    try_cutoffs(tuning.cutoff.shortest * mean_edge_length_, [](double) { return true; });
  }
  trials_->restart(sharp_angle);
  CutoffChoice choice;
  try_cutoffs(shortest, [&](double next) {
    choice.noise = trials_->noise();
    choice.trials = trials_->risks();
    const bool enough =
        is_enough(choice.trials, choice.noise, keeps_creases) && !looks_further(next);
    return enough || next > search_.largest;
  });
  choice.looks_white = is_white(trials_->bands());
  if (trials_->has_outliers()) {
    choice.kind = NoiseKind::outliers;
  } else if (is_correlated(trials_->bands())) {
    choice.kind = NoiseKind::correlated;
    choice.cutoff = cutoff_of_noise(trials_->bands());
    return choice;
  }
  choice.cutoff = between(choice.trials, least(choice.trials), keeps_creases);
  return choice;
}

CutoffChoice choose_cutoff(const Points& X, const Topology& topology,
                           const std::vector<std::uint8_t>& fixed, const FlowOptions& options,
                           const CutoffSearch& search) {
  CutoffChooser chooser(X, topology, fixed, options, search);
  return chooser.choose(options.sharp_angle, tuning.cutoff.shortest * chooser.mean_edge_length());
}

}  // namespace ibmfair
