// The kinds of noise that the choice of a cut-off tells apart: made noise on made shapes.
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "ibmfair/base/random_numbers.h"
#include "ibmfair/flow/fixed_vertices.h"
#include "ibmfair/flow/settings/cutoff_choice.h"
#include "ibmfair/flow/settings/evenness.h"
#include "ibmfair/flow/settings/level_steps.h"
#include "ibmfair/flow/settings/noise_kind.h"
#include "ibmfair/flow/settings/noise_model.h"
#include "ibmfair/flow/steps/unknown_normals.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/shapes/noise.h"
#include "ibmfair/shapes/shapes.h"
#include "support/correlated_noise.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

State ball() {
  return State(make_shape("icosphere", {.subdivide = 4}));
}

State torus() {
  return State(make_shape("torus", {.ratio = 2.5, .rows = 40}));
}

/// Moves one vertex in five by noise of this standard deviation (mean edge lengths).
void add_outliers(State& state, double deviation) {
  Points noise = Points::Zero(state.X.rows(), 3);
  add_noise(noise, deviation * edge_of(state), 3);
  RandomNumbers random(4);
  for (Index v = 0; v < state.X.rows(); ++v) {
    if (random.normal() > 0.84) {
      state.X.row(v) += noise.row(v);
    }
  }
}

/// A random number with the standard deviation 1.
using Distribution = double (*)(RandomNumbers&);

/// Two distributions with lighter tails than a normal one: uniform, and -1 or 1.
constexpr Distribution light_tails[] = {
    [](RandomNumbers& random) { return std::sqrt(12.0) * (random.uniform() - 0.5); },
    [](RandomNumbers& random) { return random.uniform() < 0.5 ? -1.0 : 1.0; }};

void add_noise_like(Distribution distribution, State& state, double deviation) {
  RandomNumbers random(5);
  const double scale = deviation * edge_of(state);
  for (double& x : state.X.reshaped()) {
    x += scale * distribution(random);
  }
}

CutoffChoice choice_for(const State& state) {
  return choose_cutoff(
      state.X, state.topology, fixed_vertices(state.topology, BoundaryCondition::fixed),
      {.laplacian = "umbrella", .steps = 8, .relax = false, .twicing = 1}, {.largest = 1});
}

TEST(NoiseKind, IsIndependentOfNormalNoiseOfAnyStrength) {
  for (const double deviation : {0.05, 0.1, 0.3, 0.5}) {
    for (State state : {ball(), torus()}) {
      add_noise(state.X, deviation * edge_of(state), 3);
      EXPECT_EQ(choice_for(state).kind, NoiseKind::independent) << deviation;
    }
  }
}

TEST(NoiseKind, IsIndependentOfLightTailsWhoseStandardDeviationIsFound) {
  for (const Distribution distribution : light_tails) {
    for (const double deviation : {0.1, 0.2, 0.3, 0.5}) {
      for (State state : {ball(), torus()}) {
        const double edge = edge_of(state);
        add_noise_like(distribution, state, deviation);
        const CutoffChoice choice = choice_for(state);
        EXPECT_EQ(choice.kind, NoiseKind::independent) << deviation;
        EXPECT_NEAR(choice.noise.deviation, deviation * edge, 0.1 * deviation * edge);
      }
      State cube(make_shape("cube", {.subdivide = 5}));
      add_noise_like(distribution, cube, deviation);
      EXPECT_EQ(choice_for(cube).kind, NoiseKind::independent) << deviation;
    }
  }
}

/// The root mean square of the moves from one state to another along the normals of the first.
double rms_along_normals(const State& from, const State& to) {
  const Unknowns unknowns(fixed_vertices(from.topology, BoundaryCondition::fixed));
  const Eigen::VectorXd heights =
      heights_along(unknown_normals(from.X, from.topology, unknowns), to.X, from.X, unknowns);
  return std::sqrt(heights.squaredNorm() / static_cast<double>(heights.size()));
}

/// How strong noise is at the point x of a shape in [-1, 1]^3.
using Strength = Vec3 (*)(const Vec3& x);

constexpr Strength uneven_strengths[] = {
    [](const Vec3& /*x*/) { return Vec3(0, 0, 1); },  // along one axis only
    [](const Vec3& x) -> Vec3 { return Vec3::Constant(1 + x[0]); },
    [](const Vec3& x) -> Vec3 { return Vec3::Constant(x[0] > 0 ? 1 : 0); }};

TEST(NoiseKind, IsIndependentOfUnevenNoiseWhoseStandardDeviationIsFound) {
  for (const Strength strength : uneven_strengths) {
    for (const double deviation : {0.1, 0.3}) {
      for (const State& exact : {ball(), torus()}) {
        State state = exact;
        Points noise = Points::Zero(state.X.rows(), 3);
        add_noise(noise, deviation * edge_of(exact), 3);
        for (Index v = 0; v < state.X.rows(); ++v) {
          const Vec3 x = exact.X.row(v) / exact.X.cwiseAbs().maxCoeff();
          state.X.row(v) += noise.row(v).cwiseProduct(strength(x).transpose());
        }
        const double rms = rms_along_normals(exact, state);
        const CutoffChoice choice = choice_for(state);
        EXPECT_EQ(choice.kind, NoiseKind::independent) << deviation;
        EXPECT_NEAR(choice.noise.deviation, rms, 0.15 * rms) << deviation;
        EXPECT_GT(choice.cutoff, 6 * edge_of(exact)) << deviation;
      }
    }
  }
}

TEST(NoiseKind, IsIndependentWithoutNoise) {
  for (const State& state :
       {ball(), torus(), State(make_shape("cube", {.subdivide = 4})),
        State(make_shape("icosahedron", {.subdivide = 4})), State(make_shape("plane", {}))}) {
    EXPECT_EQ(choice_for(state).kind, NoiseKind::independent);
  }
}

TEST(NoiseKind, CorrelatedNoiseIsFoundAndRemovedByALongerCutoff) {
  for (const int passes : {1, 2}) {
    for (State state : {ball(), torus()}) {
      add_correlated_noise(state, 0.2, passes);
      const CutoffChoice choice = choice_for(state);
      EXPECT_EQ(choice.kind, NoiseKind::correlated) << passes;
      EXPECT_GT(choice.cutoff, 5 * edge_of(state)) << passes;
    }
  }
}

TEST(NoiseModel, TellsHowStrongCorrelatedNoiseIsAndHowFarItReaches) {
  for (const int passes : {1, 2, 4}) {
    for (const double deviation : {0.1, 0.3}) {
      SCOPED_TRACE(std::to_string(passes) + " passes, " + std::to_string(deviation));
      State state = ball();
      const double edge = edge_of(state);
      add_correlated_noise(state, deviation, passes);
      const CutoffChoice choice = choice_for(state);
      EXPECT_EQ(choice.noise.rings, passes);
      EXPECT_NEAR(choice.noise.deviation, deviation * edge, 0.12 * deviation * edge);
      EXPECT_NEAR(choice.noise.reach(), 2 * std::sqrt(passes), 1e-12);
    }
  }
}

/// Creases stand out of the shortest bands, where noise that reaches over some edges hardly shows.
TEST(NoiseKind, CorrelatedNoiseIsFoundOnACube) {
  for (const int passes : {1, 2, 4}) {
    State state(make_shape("cube", {.subdivide = 5}));
    add_correlated_noise(state, 0.3, passes);
    EXPECT_EQ(choice_for(state).kind, NoiseKind::correlated) << passes;
  }
}

TEST(NoiseModel, TellsWhiteNoiseFromTheCorrelatedNoiseThatIsMixedWithIt) {
  for (const double deviation : {0.1, 0.2}) {
    for (State state : {ball(), torus()}) {
      SCOPED_TRACE(deviation);
      const double whole = std::sqrt(2.0) * deviation * edge_of(state);
      add_mixed_noise(state, deviation);
      const NoiseModel noise = choice_for(state).mixed_noise;
      EXPECT_NEAR(noise.deviation, whole, 0.2 * whole);
      EXPECT_GE(noise.rings, 1);
      EXPECT_NEAR(noise.white_share, 0.5, 0.15);
    }
  }
}

TEST(NoiseModel, OfWhiteNoiseIsNoMixture) {
  for (const double deviation : {0.05, 0.1, 0.2, 0.4}) {
    for (State state : {ball(), torus()}) {
      add_noise(state.X, deviation * edge_of(state), 3);
      EXPECT_EQ(choice_for(state).mixed_noise.deviation, 0) << deviation;
    }
  }
}

/// Details as short as twelve edges that cover the whole surface are none either.
TEST(NoiseModel, OfWhiteNoiseOnFineDetailsIsWhite) {
  for (const double deviation : {0.05, 0.07, 0.1, 0.2}) {
    State state(make_shape("icosphere", {.subdivide = 5}));
    const double edge = edge_of(state), wave = 2 * std::numbers::pi / (12 * edge);
    for (auto x : state.X.rowwise()) {
      x *= 1 + edge * std::sin(wave * x[0]) * std::sin(wave * x[1]) * std::sin(wave * x[2]);
    }
    add_noise(state.X, deviation * edge, 3);
    const CutoffChoice choice = choice_for(state);
    EXPECT_EQ(choice.kind, NoiseKind::independent) << deviation;
    EXPECT_EQ(choice.mixed_noise.deviation, 0) << deviation;
  }
}

TEST(NoiseModel, NoiseLikeItHasItsStandardDeviationAndCorrelations) {
  const State state = ball();
  const Unknowns unknowns(std::vector<std::uint8_t>(state.X.rows(), 0));
  const Points white = white_noise(unknowns.size());
  const auto likeness = [&](const NoiseModel& model) {  // of neighbours
    const Points noise = noise_like(model, white, state.topology, unknowns);
    EXPECT_NEAR(noise.squaredNorm() / static_cast<double>(noise.size()), 1, 0.03);
    double sum = 0;
    for (const auto& edge : state.topology.E.rowwise()) {
      sum += noise.row(edge[0]).dot(noise.row(edge[1]));
    }
    return sum / static_cast<double>(3 * state.topology.E.rows());
  };
  const double whole = likeness({.deviation = 1, .rings = 2});
  EXPECT_NEAR(likeness({.deviation = 1, .rings = 0}), 0, 0.03);
  EXPECT_GT(whole, 0.7);
  for (const double share : {0.25, 0.5, 0.75}) {
    EXPECT_NEAR(likeness({.deviation = 1, .rings = 2, .white_share = share}), (1 - share) * whole,
                0.03);
  }
}

TEST(NoiseKind, OutliersCountInTheStandardDeviation) {
  for (const double deviation : {0.5, 1.0}) {
    for (State state : {ball(), torus()}) {
      add_outliers(state, deviation);
      const CutoffChoice choice = choice_for(state);
      EXPECT_EQ(choice.kind, NoiseKind::outliers) << deviation;
      // One vertex in five has the whole variance, the others none. The normals of a mesh with
      // strong noise are tilted, so that heights along them are smaller than the noise.
      const double whole = std::sqrt(0.2) * deviation * edge_of(state);
      EXPECT_LT(choice.noise.deviation, 1.1 * whole) << deviation;
      EXPECT_GT(choice.noise.deviation, 0.7 * whole) << deviation;
    }
  }
}

TEST(NoiseKind, DoesNotDependOnTheUnit) {
  for (const double unit : {1e-8, 1e8}) {
    State state = torus();
    add_correlated_noise(state, 0.2, 1);
    state.X *= unit;
    const CutoffChoice choice = choose_cutoff(
        state.X, state.topology, fixed_vertices(state.topology, BoundaryCondition::fixed),
        {.laplacian = "umbrella", .steps = 8, .relax = false, .twicing = 1}, {.largest = unit});
    EXPECT_EQ(choice.kind, NoiseKind::correlated) << unit;
  }
}

TEST(Evenness, IsThatOfTheCoveredShare) {
  const State state = torus();
  const std::vector<std::uint8_t> fixed(state.X.rows(), 0);
  const Unknowns unknowns(fixed);
  std::vector<Index> all(unknowns.vertex);
  Eigen::VectorXd values = Eigen::VectorXd::Constant(state.X.rows(), 3);
  EXPECT_NEAR(evenness(values, state.topology, unknowns, all, 8), 1, 1e-12);
  for (Index v = 0; v < state.X.rows(); ++v) {
    values[v] = state.X(v, 0) > 0 ? 1 : 0;
  }
  EXPECT_LT(evenness(values, state.topology, unknowns, all, 8), 0.1);
}

/// A hill of heights over a grid of 60 x 60 squares of side 1.
State hill(bool rounded) {
  State state(make_shape("plane", {.rows = 61, .columns = 61, .straight = true}));
  const Eigen::RowVector3d low = state.X.colwise().minCoeff();
  const double side = 60 / (state.X.colwise().maxCoeff().x() - low.x());
  for (auto x : state.X.rowwise()) {
    x = (side * (x - low)).array().round();
    x[2] = 12 * std::sin(x[0] / 15) * std::cos(x[1] / 18);
    if (rounded) {
      x[2] = std::round(x[2]);
    }
  }
  return state;
}

TEST(LevelStep, IsFoundInRoundedHeightsOnly) {
  EXPECT_NEAR(level_step(hill(true).X, hill(true).topology), 1, 0.1);
  EXPECT_EQ(level_step(hill(false).X, hill(false).topology), 0);
}

TEST(LevelStep, IsFoundInRoundedCoordinates) {
  State state = ball();
  const double step = 0.5 * edge_of(state);
  state.X = (state.X / step).array().round() * step;
  EXPECT_NEAR(level_step(state.X, state.topology), step, 1e-9 * step);
}

TEST(LevelStep, IsZeroForShapesAndForNoise) {
  for (const char* shape : {"cube", "icosphere"}) {
    State state(make_shape(shape, {.subdivide = 4}));
    EXPECT_EQ(level_step(state.X, state.topology), 0) << shape;
    add_noise(state.X, 0.2 * edge_of(state), 3);
    EXPECT_EQ(level_step(state.X, state.topology), 0) << shape;
  }
}

}  // namespace
}  // namespace ibmfair::test
