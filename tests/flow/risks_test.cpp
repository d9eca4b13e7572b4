// The risks that are estimated from noisy spheres, beside the errors that are left.
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "ibmfair/flow/settings/added_noise.h"
#include "ibmfair/flow/settings/cutoff_trials.h"
#include "ibmfair/flow/settings/trial_mesh.h"
#include "ibmfair/flow/settings/trial_smoother.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/shapes/noise.h"
#include "ibmfair/shapes/shapes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

struct Errors {
  double distance = 0, slope = 0;  // mean squares: of heights, and half that of differences
};

/// Of positions near the unit sphere.
Errors errors_on_sphere(const Points& X, const Topology& topology) {
  const Eigen::VectorXd height = X.rowwise().norm().array() - 1;
  const Eigen::VectorXd difference = height(topology.E.col(0)) - height(topology.E.col(1));
  return {height.squaredNorm() / static_cast<double>(height.size()),
          difference.squaredNorm() / static_cast<double>(2 * difference.size())};
}

/// Each vertex at the mean of itself and its neighbours.
Points averaged(const Points& X, const Topology& topology) {
  Points sum = X;
  Eigen::VectorXd count = Eigen::VectorXd::Ones(X.rows());
  for (const auto& e : topology.E.rowwise()) {
    sum.row(e[0]) += X.row(e[1]);
    sum.row(e[1]) += X.row(e[0]);
    count[e[0]] += 1;
    count[e[1]] += 1;
  }
  return sum.array().colwise() / count.array();
}

/// A sphere with noise that is white (0 rings) or correlated.
struct NoisySphere {
  explicit NoisySphere(int rings) : model{0.2 * edge, rings} {
    add_noise(Y, 1, 5);
    Y = truth.X + model.deviation * noise_like(model, Y, truth.topology, Unknowns(fixed));
  }

  double variance() const { return model.variance(); }
  /// Of half the mean squared slope of the noise in its variance.
  double slope_share() const { return errors_on_sphere(Y, truth.topology).slope / variance(); }
  /// The variance of as many independent heights as there are vertices has a standard error of 1.4
  /// %. Correlated noise has fewer.
  double doubt() const { return 0.03 * (1 + model.rings); }

  const State truth{make_shape("icosphere", {.subdivide = 5})};
  const std::vector<std::uint8_t> fixed = std::vector<std::uint8_t>(truth.X.rows(), 0);
  const double edge = mean_edge_length(truth.X, truth.topology.E);
  const FlowOptions options{.laplacian = "umbrella", .steps = 8, .relax = false};
  const NoiseModel model;
  Points Y = Points::Zero(truth.X.rows(), 3);
  const TrialMesh mesh{Y, truth.topology, fixed, options, {truth.topology.vertex_count, 0}};
};

TEST(CutoffTrials, TellTheErrorsOfTheirSmoother) {
  for (const int rings : {0, 1, 3}) {
    for (const bool is_given : {true, false}) {
      if (!is_given && rings > 0) {
        continue;  // only white noise is measured
      }
      SCOPED_TRACE("rings " + std::to_string(rings) + (is_given ? ", given" : ", measured"));
      const NoisySphere sphere(rings);
      const double variance = sphere.variance();
      CutoffTrials trials(sphere.mesh, is_given ? sphere.model : NoiseModel());
      const Unknowns unknowns(sphere.fixed);
      const auto smoother = make_trial_smoother(sphere.mesh, unknowns);
      std::vector<Errors> left;
      for (const double edges : {2.0, 3.0, 4.5, 7.0, 10.0}) {
        trials.run(edges * sphere.edge);
        left.push_back(
            errors_on_sphere(smoother->smooth(edges * sphere.edge), sphere.truth.topology));
      }
      ASSERT_TRUE(trials.know_noise());
      EXPECT_NEAR(trials.noise(), sphere.model.deviation, 0.02 * sphere.model.deviation);
      EXPECT_EQ(trials.bands().empty(), is_given);
      const std::vector<CutoffTrial> risks = trials.risks();
      for (std::size_t i = 0; i < left.size(); ++i) {
        const double slope = left[i].slope / sphere.slope_share();
        EXPECT_NEAR(risks[i].risk, left[i].distance,
                    sphere.doubt() * (variance + left[i].distance));
        EXPECT_NEAR(risks[i].slope_risk, slope, sphere.doubt() * (variance + slope));
        EXPECT_EQ(risks[i].slope_weight > 0, rings > 0);
      }
    }
  }
}

TEST(AddedNoise, TellsTheErrorsOfAnyMappingOfASphere) {
  for (const int rings : {0, 1, 3}) {
    const NoisySphere sphere(rings);
    const State& truth = sphere.truth;
    const double edge = sphere.edge;
    const double noise = sphere.model.deviation, variance = sphere.variance();
    const AddedNoise added(sphere.mesh, sphere.model, sphere.options, 4 * edge);
    const std::vector<std::pair<std::string, std::function<Points(const Points&)>>> mappings{
        {"all noise is kept", [](const Points& X) { return X; }},
        {"all noise is removed", [&](const Points&) { return truth.X; }},
        {"a mean of neighbours", [&](const Points& X) { return averaged(X, truth.topology); }},
        {"a smaller sphere", [&](const Points& X) { return Points(X * (1 - noise)); }}};
    for (const auto& [name, mapping] : mappings) {
      SCOPED_TRACE(name + ", rings " + std::to_string(rings));
      const std::array ends{mapping(added.starts()[0]), mapping(added.starts()[1])};
      const Errors one = errors_on_sphere(ends[0], truth.topology);
      const Errors other = errors_on_sphere(ends[1], truth.topology);
      const CutoffTrial trial = added.trial(4 * edge, ends);
      EXPECT_EQ(trial.cutoff, 4 * edge);
      const double distance = (one.distance + other.distance) / 2;
      const double slope = (one.slope + other.slope) / 2 / sphere.slope_share();
      EXPECT_NEAR(trial.risk, distance, sphere.doubt() * (variance + distance));
      EXPECT_NEAR(trial.slope_risk, slope, sphere.doubt() * (variance + slope));
    }
  }
}

}  // namespace
}  // namespace ibmfair::test
