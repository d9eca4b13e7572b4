#include "ibmfair/flow/settings/noise_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>

#include "ibmfair/base/random_numbers.h"
#include "ibmfair/flow/settings/choice_tuning.h"
#include "ibmfair/flow/settings/ring_means.h"
#include "ibmfair/flow/settings/trial_smoother.h"

namespace ibmfair {
namespace {

constexpr std::array correlated_rings{1, 2, 4};

Eigen::Array3d rms_of_columns(const Points& rows) {
  return (rows.colwise().squaredNorm() / static_cast<double>(rows.rows())).cwiseSqrt().transpose();
}

/// The ratios of what is seen in bands to what a model makes of them: the model fits if all are the
/// same.
struct Fit {
  double least_log = std::numeric_limits<double>::infinity(), largest_log = -least_log;
  double sum_of_logs = 0;
  int count = 0;
  double least_before = std::numeric_limits<double>::infinity();  // in shorter bands

  void add(double ratio) {
    const double log = std::log(ratio);
    least_log = std::min(least_log, log);
    largest_log = std::max(largest_log, log);
    sum_of_logs += log;
    ++count;
  }
  double spread() const { return largest_log - least_log; }
  double mean() const { return std::exp(sum_of_logs / count); }
};

}  // namespace

NoiseModel fit_noise_model(const TrialMesh& mesh, const std::vector<NoiseBand>& bands) {
  const BandRange range = bands_of_correlated_noise(bands);
  if (range.empty()) {
    return {};
  }
  const Unknowns unknowns(mesh.fixed());
  const std::vector<Index> counted = counted_unknowns(mesh, unknowns);
  const Points white = white_noise(unknowns.size());
  Points noise(unknowns.size(), 3);  // a model in each column
  for (std::size_t m = 0; m < correlated_rings.size(); ++m) {
    noise.col(static_cast<Eigen::Index>(m)) =
        correlated_noise(white, correlated_rings[m], mesh.topology(), unknowns).col(0);
  }
  const std::unique_ptr<TrialSmoother> smoother = make_trial_smoother(mesh, unknowns);
  std::array<Fit, correlated_rings.size()> fits;
  Points last = Points::Zero(static_cast<Eigen::Index>(counted.size()), 3);
  for (std::size_t i = 0; i < range.end; ++i) {
    smoother->smooth(bands[i].cutoff);
    const Points taken = smoother->taken_of(noise)(counted, Eigen::all);
    const Eigen::Array3d expected = rms_of_columns(taken - last);
    for (std::size_t m = 0; m < fits.size(); ++m) {
      const double ratio =
          bands[i].by_median * bands[i].white / expected[static_cast<Eigen::Index>(m)];
      if (i >= range.begin) {
        fits[m].add(ratio);
      } else {
        fits[m].least_before = std::min(fits[m].least_before, ratio);
      }
    }
    last = taken;
  }
  const auto best = std::ranges::min_element(fits, {}, &Fit::spread);
  if (best->mean() < choice_tuning.noise.negligible ||
      best->least_before < choice_tuning.noise.shows * best->mean()) {
    return {};
  }
  return {best->mean() * mesh.mean_edge_length(),
          correlated_rings[static_cast<std::size_t>(best - fits.begin())]};
}

Points white_noise(Index count) {
  RandomNumbers random(1);
  Points z(count, 3);
  for (double& number : z.reshaped()) {
    number = random.normal();
  }
  return z;
}

Points correlated_noise(const Points& white, int rings, const Topology& topology,
                        const Unknowns& unknowns) {
  if (rings == 0) {
    return white;
  }
  const Points noise = ring_means(white, topology, unknowns, rings);
  return std::sqrt(static_cast<double>(noise.size()) / noise.squaredNorm()) * noise;
}

}  // namespace ibmfair
