#include "ibmfair/flow/settings/noise_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>

#include <Eigen/QR>

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
  double least_before = std::numeric_limits<double>::infinity(), most_before = 0;  // shorter bands

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

/// Whether what the best model was fitted to may be even detail of the shape. `in_all`: the bands
/// begin with the shortest.
bool may_be_detail(const Fit& fit, bool in_all) {
  const bool unlike_before =
      !in_all && (fit.least_before < choice_tuning.noise.shows * fit.mean() * fit.mean() ||
                  fit.most_before > choice_tuning.noise.too_much_before * fit.mean());
  return unlike_before || fit.spread() > choice_tuning.noise.poor_fit;
}

/// What the models of correlated noise of the standard deviation 1 make of the first bands: the rms
/// height, #bands x #models.
Eigen::ArrayX3d bands_of_models(const TrialMesh& mesh, const std::vector<NoiseBand>& bands,
                                std::size_t count) {
  const Unknowns unknowns(mesh.fixed());
  const std::vector<Index> counted = counted_unknowns(mesh, unknowns);
  const Points white = white_noise(unknowns.size());
  Points noise(unknowns.size(), 3);  // a model in each column
  for (std::size_t m = 0; m < correlated_rings.size(); ++m) {
    noise.col(static_cast<Eigen::Index>(m)) =
        noise_like({1, correlated_rings[m]}, white, mesh.topology(), unknowns).col(0);
  }
  const std::unique_ptr<TrialSmoother> smoother = make_trial_smoother(mesh, unknowns);
  Eigen::ArrayX3d expected(static_cast<Eigen::Index>(count), 3);
  Points last = Points::Zero(static_cast<Eigen::Index>(counted.size()), 3);
  for (std::size_t i = 0; i < count; ++i) {
    smoother->smooth(bands[i].cutoff);
    const Points taken = smoother->taken_of(noise)(counted, Eigen::all);
    expected.row(static_cast<Eigen::Index>(i)) = rms_of_columns(taken - last).transpose();
    last = taken;
  }
  return expected;
}

/// The x >= 0 with the least |A x - b|.
Eigen::Vector2d non_negative_least_squares(const Eigen::MatrixX2d& A, const Eigen::VectorXd& b) {
  const Eigen::Vector2d x = A.colPivHouseholderQr().solve(b);
  for (const int i : {0, 1}) {
    if (x[i] < 0) {
      return A.col(1 - i).dot(b) / A.col(1 - i).squaredNorm() * Eigen::Vector2d::Unit(1 - i);
    }
  }
  return x;
}

}  // namespace

NoiseModel fit_noise_model(const TrialMesh& mesh, const std::vector<NoiseBand>& bands) {
  const BandRange range = bands_of_correlated_noise(bands);
  if (range.empty()) {
    return {};
  }
  const Eigen::ArrayX3d expected = bands_of_models(mesh, bands, range.end);
  std::array<Fit, correlated_rings.size()> fits;
  for (std::size_t i = 0; i < range.end; ++i) {
    for (std::size_t m = 0; m < fits.size(); ++m) {
      const double ratio = bands[i].by_median * bands[i].white /
                           expected(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(m));
      if (i >= range.begin) {
        fits[m].add(ratio);
      } else {
        fits[m].least_before = std::min(fits[m].least_before, ratio);
        fits[m].most_before = std::max(fits[m].most_before, ratio);
      }
    }
  }
  const auto best = std::ranges::min_element(fits, {}, &Fit::spread);
  if (best->mean() < choice_tuning.noise.negligible || may_be_detail(*best, range.begin == 0)) {
    return {};
  }
  if (best->spread() > choice_tuning.noise.good_fit) {
    if (const NoiseModel mixed = fit_mixed_noise(mesh, bands); mixed.deviation > 0) {
      return mixed;
    }
  }
  return {best->mean() * mesh.mean_edge_length(),
          correlated_rings[static_cast<std::size_t>(best - fits.begin())]};
}

NoiseModel fit_mixed_noise(const TrialMesh& mesh, const std::vector<NoiseBand>& bands) {
  const BandRange range = bands_of_mixed_noise(bands);
  if (range.empty()) {
    return {};
  }
  const Eigen::ArrayX3d expected = bands_of_models(mesh, bands, range.end);
  const Eigen::Index count = expected.rows();
  Eigen::ArrayXd seen(count), white(count), weights = Eigen::ArrayXd::Ones(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    white[i] = bands[static_cast<std::size_t>(i)].white;
    seen[i] = bands[static_cast<std::size_t>(i)].by_median * white[i];
  }
  weights[count - 1] = choice_tuning.noise.last_weight;
  double least = std::numeric_limits<double>::infinity();
  NoiseModel best;
  for (std::size_t m = 0; m < correlated_rings.size(); ++m) {
    Eigen::MatrixX2d A(count, 2);  // relative mean squares
    A << weights * (white / seen).square(),
        weights * (expected.col(static_cast<Eigen::Index>(m)) / seen).square();
    const Eigen::Vector2d variances = non_negative_least_squares(A, weights);
    const double error = (A * variances - weights.matrix()).squaredNorm();
    // Details of the shape only enlarge longer bands, so that too many rings fit them.
    if (error < least - choice_tuning.noise.better_fit) {
      least = error;
      best = {std::sqrt(variances.sum()) * mesh.mean_edge_length(), correlated_rings[m],
              variances[0] / variances.sum()};
    }
  }
  return best.white_share < 1 - choice_tuning.noise.correlated_share ? best : NoiseModel();
}

Points white_noise(Index count) {
  RandomNumbers random(1);
  Points z(count, 3);
  for (double& number : z.reshaped()) {
    number = random.normal();
  }
  return z;
}

Points noise_like(const NoiseModel& model, const Points& white, const Topology& topology,
                  const Unknowns& unknowns) {
  if (model.is_white()) {
    return white;
  }
  Points noise = ring_means(white, topology, unknowns, model.rings);
  noise *=
      std::sqrt((1 - model.white_share) * static_cast<double>(noise.size()) / noise.squaredNorm());
  if (model.white_share > 0) {
    // The white noise of vertices far away in the list is independent of that around a vertex.
    const Eigen::Index half = white.rows() / 2, rest = white.rows() - half;
    const double scale = std::sqrt(model.white_share);
    noise.topRows(rest) += scale * white.bottomRows(rest);
    noise.bottomRows(half) += scale * white.topRows(half);
  }
  return noise;
}

}  // namespace ibmfair
