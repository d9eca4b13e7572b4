// Flows with longer and longer cut-off wavelengths. For each, the noise that it leaves plus the
// part of the shape that it removes (the risk) is estimated from the noisy mesh alone.
//
// Let F be a smoother that is nearly linear in the heights of the vertices over the surface, and
// let y = x + noise be the noisy heights. The expected mean squared distance of F y to x is
//
//   risk = |y - F y|^2 / n + 2 s^2 tr F / n - s^2
//
// with s the standard deviation of the noise: C. Stein, "Estimation of the mean of a multivariate
// normal distribution", Annals of Statistics 9 (1981). No term needs x. F is not known as a matrix,
// so tr F is estimated as the mean of z^T F z over random z (S. Ramani, T. Blu, M. Unser,
// "Monte-Carlo SURE", IEEE Transactions on Image Processing 17, 2008), and s as the distance by
// which the flow with a short cut-off moves the vertices, over the distance by which it moves white
// noise.
//
// This estimate of the risk also holds for differences of neighbouring heights in place of heights,
// and for correlated noise, if z has its correlations.
//
// F z is computed by the flow linearised at the end state (trial_smoother.h). Flows that keep
// creases are no such smoothers: flow/settings/added_noise.h estimates their risk.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "ibmfair/energy/unknowns.h"
#include "ibmfair/flow/settings/choice_tuning.h"
#include "ibmfair/flow/settings/height_differences.h"
#include "ibmfair/flow/settings/noise_kind.h"
#include "ibmfair/flow/settings/noise_model.h"
#include "ibmfair/flow/settings/risk_curve.h"
#include "ibmfair/flow/settings/trial_mesh.h"
#include "ibmfair/flow/settings/trial_smoother.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

class CutoffTrials {
 public:
  /// `mesh` must outlive this object; the sharp angle of its options is not used. `noise`: if its
  /// deviation is 0, it is taken for white, and the deviation is estimated in the second trial.
  /// Throws BadMesh if no counted vertex moves.
  explicit CutoffTrials(const TrialMesh& mesh, const NoiseModel& noise = {});

  /// Runs a trial. Cut-offs (length) must increase from trial to trial. Throws the exceptions of
  /// the flow.
  void run(double cutoff);

  /// Whether the noise is known. A known noise may be 0.
  bool know_noise() const {
    return is_given_ || outcomes_.size() > choice_tuning.cutoff.noise_trial;
  }
  double noise() const { return noise_.deviation; }
  /// The standard deviation (length) of the white part of the first two bands, of any distribution
  /// and wherever it is. Precondition: the noise is known, and was not given.
  double white_deviation() const;
  /// The standard error of the risks, length^2, the same for all trials: by chance, the noise of
  /// this mesh is a little stronger or weaker than its standard deviation says, and that is known
  /// only from so many vertices. What is systematically wrong is not in it: detail that is taken
  /// for noise, or noise that is not independent.
  double risk_error() const;
  /// Whether the noise has outliers. False if the noise was given.
  bool has_outliers() const { return has_outliers_; }

  /// What the trials removed, one after the other. Empty if the noise was given.
  const std::vector<NoiseBand>& bands() const { return bands_; }

  /// The risks of all trials. Precondition: the noise is known.
  std::vector<CutoffTrial> risks() const;

 private:
  /// What a smoother does to heights, or to their differences between neighbours.
  struct Effect {
    double squared_move = 0;  // mean square
    double trace = 0;         // tr F / n

    double risk(double variance) const { return squared_move + variance * (2 * trace - 1); }
  };
  /// The result of a flow with one cut-off.
  struct Outcome {
    double cutoff;
    Effect on_heights, on_slopes;
  };

  void add_band(double cutoff, const Points& normals, const Points& end, const Points& taken);
  void estimate_noise(const Eigen::VectorXd& height, const Points& taken);
  bool falls_by_law(double cutoff, double trace) const;

  const TrialMesh& mesh_;
  const Topology& topology_;
  const double mean_edge_;
  Unknowns unknowns_;
  std::vector<Index> counted_;  // unknowns whose vertices are counted
  const HeightDifferences differences_;
  const std::unique_ptr<TrialSmoother> smoother_;
  NoiseModel noise_;
  const bool is_given_;       // the noise
  Points unit_noise_;         // #unknowns x 3: three vectors take little longer to smooth than one
  const double slope_share_;  // of half the mean squared slope of the noise in its variance
  std::vector<Outcome> outcomes_;
  std::vector<NoiseBand> bands_;
  Points end_, taken_;        // of the last trial: the mesh with twicing, the noise removed
  bool trace_falls_ = false;  // tr F follows Weyl's law from here on
  double noise_doubt_ = 0;    // standard error of noise^2, over noise^2
  bool has_outliers_ = false;
};

}  // namespace ibmfair
