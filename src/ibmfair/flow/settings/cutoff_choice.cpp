#include "ibmfair/flow/settings/cutoff_choice.h"

#include <algorithm>
#include <cmath>

#include "ibmfair/flow/settings/added_noise.h"
#include "ibmfair/flow/settings/choice_tuning.h"
#include "ibmfair/flow/settings/trial_mesh.h"

namespace ibmfair {
namespace {

/// Whether longer cut-offs are not expected to reduce the risk. `variance`: of the noise.
bool is_enough(const std::vector<CutoffTrial>& trials, double variance) {
  const double last = trials.back().total();
  return last - trials[least_risk(trials)].total() > choice_tuning.cutoff.clear_rise * variance ||
         (trials.size() > 2 && std::abs(trials[trials.size() - 3].total() - last) <=
                                   choice_tuning.cutoff.small_gain * variance);
}

/// Whether the next cut-off is to be tried to learn about correlated noise.
bool looks_further(const CutoffTrials& trials) {
  return !trials.has_outliers() && may_tell_more(trials.bands());
}

/// Runs trials from the shortest cut-off upward until `done(next cut-off)`.
template <class Done>
void try_cutoffs(CutoffTrials& trials, const TrialMesh& mesh, const CutoffSearch& search,
                 const Done& done) {
  for (double cutoff = choice_tuning.cutoff.shortest * mesh.mean_edge_length();;
       cutoff *= std::sqrt(2.0)) {
    search.tell(cutoff);
    trials.run(cutoff);
    if (trials.know_noise() && done(std::sqrt(2.0) * cutoff)) {
      return;
    }
  }
}

/// If the noise is correlated, the choice has no cut-off yet.
CutoffChoice choose_without_creases(const TrialMesh& mesh, const CutoffSearch& search) {
  CutoffTrials trials(mesh);
  CutoffChoice choice;
  try_cutoffs(trials, mesh, search, [&](double next) {
    choice.noise.deviation = trials.noise();
    choice.trials = trials.risks();
    const bool enough = is_enough(choice.trials, choice.noise.variance()) && !looks_further(trials);
    return enough || next > search.largest;
  });
  choice.risk_error = trials.risk_error();
  choice.white_noise = trials.white_deviation();
  choice.looks_white = is_white(trials.bands());
  if (trials.has_outliers()) {
    choice.kind = NoiseKind::outliers;
  } else if (const NoiseModel model = fit_noise_model(mesh, trials.bands()); model.deviation > 0) {
    choice.kind = NoiseKind::correlated;
    choice.noise = model;
    return choice;
  } else {
    choice.mixed_noise = fit_mixed_noise(mesh, trials.bands());
  }
  choice.cutoff = cutoff_of_least_risk(choice.trials, false);
  return choice;
}

CutoffChoice choose_with_creases(const TrialMesh& mesh, const CutoffSearch& search) {
  CutoffTrials trials(mesh);
  try_cutoffs(trials, mesh, search, [](double) { return true; });
  CutoffChoice choice;
  choice.noise.deviation = trials.noise();
  choice.risk_error = trials.risk_error();
  choice.kind = trials.has_outliers() ? NoiseKind::outliers : NoiseKind::independent;
  const double edge = mesh.mean_edge_length();
  if (choice.noise.deviation == 0) {
    choice.cutoff = choice_tuning.cutoff.shortest * edge;
    choice.trials = {{.cutoff = choice.cutoff}};
    return choice;
  }
  const double first = choice_tuning.creases.first_cutoff * edge;
  const AddedNoise added(mesh, choice.noise, mesh.options(), first);
  NoisierFlows flows(added, mesh.options());
  choice.trials = trials_around(
      [&](double cutoff) {
        search.tell(cutoff);
        return flows.trial(cutoff);
      },
      {.start = first,
       .shortest = choice_tuning.cutoff.shortest * edge,
       .largest = search.largest,
       .tolerance = choice_tuning.cutoff.small_gain * choice.noise.variance()});
  choice.cutoff = cutoff_of_least_risk(choice.trials, true);
  return choice;
}

}  // namespace

const CutoffTrial& CutoffChoice::best() const {
  return trials[least_risk(trials)];
}

CutoffChoice choose_cutoff(const Points& X, const Topology& topology,
                           const std::vector<std::uint8_t>& fixed, const FlowOptions& options,
                           const CutoffSearch& search) {
  const TrialMesh mesh(X, topology, fixed, options, search.sample);
  if (options.sharp_angle > 0) {
    return choose_with_creases(mesh, search);
  }
  CutoffChoice choice = choose_without_creases(mesh, search);
  if (!choice.noise.is_white()) {
    const CutoffChoice longer =
        choose_cutoff_for(choice.noise, X, topology, fixed, options, search);
    choice.cutoff = longer.cutoff;
    choice.trials = longer.trials;
  }
  return choice;
}

CutoffChoice choose_cutoff_for(const NoiseModel& noise, const Points& X, const Topology& topology,
                               const std::vector<std::uint8_t>& fixed, const FlowOptions& options,
                               const CutoffSearch& search) {
  const TrialMesh mesh(X, topology, fixed, options, search.sample_for(noise));
  CutoffTrials trials(mesh, noise);
  CutoffChoice choice;
  choice.noise = noise;
  choice.kind = NoiseKind::correlated;
  try_cutoffs(trials, mesh, search, [&](double next) {
    choice.trials = trials.risks();
    return is_enough(choice.trials, noise.variance()) || next > search.largest;
  });
  choice.cutoff = cutoff_of_least_risk(choice.trials, false);
  return choice;
}

SampleSize CutoffSearch::sample_for(const NoiseModel& noise) const {
  return noise.is_white() ? sample
                          : SampleSize{std::min(sample.vertices, choice_tuning.noise.sample),
                                       choice_tuning.noise.felt_rings};
}

}  // namespace ibmfair
