#include "ibmfair/flow/settings/cutoff_trials.h"

#include <algorithm>
#include <cmath>

#include "ibmfair/base/quantile.h"
#include "ibmfair/flow/settings/choice_tuning.h"
#include "ibmfair/flow/settings/evenness.h"
#include "ibmfair/flow/settings/hinge_noise.h"
#include "ibmfair/flow/settings/linear_smoother.h"
#include "ibmfair/flow/settings/noise_model.h"
#include "ibmfair/flow/steps/unknown_normals.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

double median_magnitude(Eigen::VectorXd values) {
  values = values.cwiseAbs();
  return median({values.data(), static_cast<std::size_t>(values.size())});
}

double rms(const Eigen::VectorXd& values) {
  return std::sqrt(mean_square(values));
}

/// tr F / n, estimated by what F takes away of noise.
double trace_of(const Points& noise, const Points& taken) {
  return 1 - noise.cwiseProduct(taken).sum() / noise.squaredNorm();
}

/// Of half the mean squared slope of noise in its variance.
double slope_share(const Points& noise, const HeightDifferences& differences) {
  return mean_square(differences(noise).reshaped()) / mean_square(noise.reshaped());
}

/// The ratio of tr F at a cut-off to that at a shorter one, by H. Weyl's law for the number of
/// modes on a surface, which holds if the edges are short compared with the cut-offs; of heights
/// and of slopes, in whose square a mode counts by the square of its frequency.
double fall_of_heights(double shorter, double longer) {
  return std::pow(shorter / longer, 2);
}
double fall_of_slopes(double shorter, double longer) {
  return std::pow(shorter / longer, 4);
}

}  // namespace

CutoffTrials::CutoffTrials(const TrialMesh& mesh, const NoiseModel& noise)
    : mesh_(mesh),
      topology_(mesh.topology()),
      mean_edge_(mean_edge_length(mesh.X(), topology_.E)),
      unknowns_(mesh.fixed()),
      counted_(counted_unknowns(mesh, unknowns_)),
      differences_(counted_, unknowns_, topology_),
      smoother_(make_trial_smoother(mesh, unknowns_)),
      noise_(noise),
      is_given_(noise.deviation > 0),
      unit_noise_(noise_like(noise, white_noise(unknowns_.size()), topology_, unknowns_)),
      slope_share_(
          noise.is_white() ? 1 : slope_share(unit_noise_(counted_, Eigen::all), differences_)) {}

void CutoffTrials::run(double cutoff) {
  const Points end = smoother_->smooth(cutoff);
  const Points normals = unknown_normals(end, topology_, unknowns_);
  const Eigen::VectorXd height = heights_along(normals, end, mesh_.X(), unknowns_)(counted_);
  Outcome outcome{cutoff, {mean_square(height)}, {mean_square(differences_(height))}};
  Points taken;  // of the noise
  if (trace_falls_) {
    const Outcome& last = outcomes_.back();
    outcome.on_heights.trace = last.on_heights.trace * fall_of_heights(last.cutoff, cutoff);
    outcome.on_slopes.trace = last.on_slopes.trace * fall_of_slopes(last.cutoff, cutoff);
  } else {
    taken = smoother_->taken_of(unit_noise_)(counted_, Eigen::all);
    const Points noise = unit_noise_(counted_, Eigen::all);
    outcome.on_heights.trace = trace_of(noise, taken);
    outcome.on_slopes.trace = trace_of(differences_(noise), differences_(taken));
    trace_falls_ = noise_.is_white() && falls_by_law(cutoff, outcome.on_heights.trace);
  }
  if (!is_given_) {
    add_band(cutoff, normals, end, taken);
    if (outcomes_.size() == choice_tuning.cutoff.noise_trial) {
      estimate_noise(height, taken);
    }
  }
  outcomes_.push_back(outcome);
}

/// `taken`: of the counted noise, or empty if unknown.
void CutoffTrials::add_band(double cutoff, const Points& normals, const Points& end,
                            const Points& taken) {
  const bool first = bands_.empty();
  const Eigen::VectorXd height = heights_along(normals, end, first ? mesh_.X() : end_, unknowns_);
  const Eigen::VectorXd counted = height(counted_);
  const double reach =
      std::max(choice_tuning.noise.least_reach, choice_tuning.noise.reach * cutoff / mean_edge_);
  NoiseBand band{cutoff, evenness(height.cwiseAbs2(), topology_, unknowns_, counted_,
                                  static_cast<int>(2 * reach))};
  if (taken.size() > 0 && !taken.isZero(0)) {
    const Points last = first ? Points::Zero(taken.rows(), 3) : taken_;
    const Eigen::VectorXd white = (taken - last).reshaped();
    band.white = rms(white);
    band.by_median = median_magnitude(counted) / median_magnitude(white) / mean_edge_;
    band.by_rms = rms(counted) / rms(white) / mean_edge_;
  }
  bands_.push_back(band);
  end_ = end;
  taken_ = taken;
}

/// `height`: the moves of the counted unknowns along the normals.
void CutoffTrials::estimate_noise(const Eigen::VectorXd& height, const Points& taken) {
  const Eigen::VectorXd white = taken.reshaped();
  if (white.isZero(0)) {  // nothing bends, as where no triangles share edges
    return;
  }
  const double by_median = median_magnitude(height) / median_magnitude(white);
  const double by_rms = rms(height) / rms(white);
  has_outliers_ = by_rms > choice_tuning.noise.outliers * by_median &&
                  bands_.back().by_rms < choice_tuning.noise.same * bands_.front().by_rms &&
                  std::all_of(bands_.begin(), bands_.end(), [](const NoiseBand& band) {
                    return band.evenness >= choice_tuning.noise.even;
                  });
  // Creases enlarge the mean square more than the median; light tails enlarge the median: that of
  // uniform noise would give a standard deviation that is too large by an eighth. Heavy tails, and
  // noise that is not equally strong everywhere, make the median too small. The linearised flow
  // does not tell light tails well enough if the flow itself is not linear.
  const bool has_light_tails =
      is_linear(mesh_.options()) && by_rms < choice_tuning.noise.light_tails * by_median;
  const double typical = has_light_tails ? by_rms : by_median, white_part = white_deviation();
  const bool by_mean_square = has_outliers_ || white_part > typical;
  noise_.deviation = has_outliers_ ? by_rms : std::max(typical, white_part);
  if (!has_outliers_ && white_part < choice_tuning.noise.white_share * typical) {
    const double by_hinges = noise_by_hinges(mesh_.X(), topology_, mesh_.fixed());
    if (by_hinges > 0 && by_hinges < choice_tuning.noise.by_hinges * typical &&
        by_hinges < choice_tuning.noise.largest_by_hinges * mean_edge_) {
      noise_.deviation = by_hinges;
    }
  }
  // As many independent heights as there are modes in them. The square of a standard deviation by
  // the median scatters by 2.33 over the root of their number.
  const double count = white.squaredNorm() / 3;
  const double fourth = height.array().pow(4).mean() / std::pow(rms(height), 4);
  noise_doubt_ = by_mean_square ? std::sqrt((fourth - 1) / count) : 2.33 / std::sqrt(count);
}

/// White noise has the same mean square in both bands, and details of a shape have a larger one in
/// the second: of the first mean square, as much is left out as the growth tells.
double CutoffTrials::white_deviation() const {
  const double first = std::pow(bands_[0].by_rms, 2), second = std::pow(bands_[1].by_rms, 2);
  const double growth = std::pow(choice_tuning.noise.growth_of_details, 2);
  const double details = std::max(second - first, 0.0) / (growth - 1);
  return mean_edge_ * std::sqrt(std::max(first - details, 0.0));
}

double CutoffTrials::risk_error() const {
  const double chance = std::sqrt(2 / static_cast<double>(counted_.size()));
  return noise_.variance() * std::hypot(noise_doubt_, chance);
}

std::vector<CutoffTrial> CutoffTrials::risks() const {
  const double variance = noise_.variance();
  std::vector<CutoffTrial> risks;
  for (const Outcome& o : outcomes_) {
    risks.push_back({.cutoff = o.cutoff,
                     .risk = o.on_heights.risk(variance),
                     .slope_risk = o.on_slopes.risk(slope_share_ * variance) / slope_share_,
                     .slope_weight = noise_.is_white() ? 0 : choice_tuning.noise.slopes});
  }
  return risks;
}

bool CutoffTrials::falls_by_law(double cutoff, double trace) const {
  if (outcomes_.empty() || cutoff < choice_tuning.cutoff.law_edges * mean_edge_) {
    return false;
  }
  const Outcome& last = outcomes_.back();
  const double by_law = last.on_heights.trace * fall_of_heights(last.cutoff, cutoff);
  return std::abs(trace - by_law) < choice_tuning.cutoff.near_law * trace;
}

}  // namespace ibmfair
