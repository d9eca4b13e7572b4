// The risks that are estimated by added noise, of mappings whose true error is known.
#include "ibmfair/flow/settings/added_noise.h"

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "ibmfair/flow/settings/trial_mesh.h"
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

TEST(AddedNoise, TellsTheErrorsOfAnyMappingOfASphere) {
  const State truth(make_shape("icosphere", {.subdivide = 5}));
  const std::vector<std::uint8_t> fixed(truth.X.rows(), 0);
  const double edge = mean_edge_length(truth.X, truth.topology.E);
  const FlowOptions options{.laplacian = "umbrella", .steps = 8, .relax = false};
  for (const int rings : {0, 1, 3}) {
    const double noise = 0.2 * edge, variance = noise * noise;
    Points Y = Points::Zero(truth.X.rows(), 3);
    add_noise(Y, 1, 5);
    Y = truth.X + noise * correlated_noise(Y, rings, truth.topology, Unknowns(fixed));
    const double slope_share = errors_on_sphere(Y, truth.topology).slope / variance;
    const TrialMesh mesh(Y, truth.topology, fixed, options, {truth.topology.vertex_count, 0});
    const AddedNoise added(mesh, {noise, rings}, options, 4 * edge);
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
      // The variance of as many independent heights as there are vertices has a standard error of
      // 1.4 %. Correlated noise has fewer.
      const double doubt = 0.03 * (1 + rings);
      const double distance = (one.distance + other.distance) / 2;
      const double slope = (one.slope + other.slope) / 2 / slope_share;
      EXPECT_NEAR(trial.risk, distance, doubt * (variance + distance));
      EXPECT_NEAR(trial.slope_risk, slope, doubt * (variance + slope));
    }
  }
}

}  // namespace
}  // namespace ibmfair::test
