// The laws of the whole flow: the guarded flow never raises the energy and folds nothing, fixed
// vertices stay, and results follow scaling and rigid motions. Options that make no sense are
// refused.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/threads.h"
#include "ibmfair/flow/fixed_vertices.h"
#include "ibmfair/flow/steps/folds.h"
#include "ibmfair/flow/time_scale.h"
#include "ibmfair/flow/willmore_flow.h"
#include "ibmfair/shapes/shapes.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

/// Options of a flow whose cut-off is given in mean edge lengths.
FlowOptions options_for(const State& state, double cutoff, FlowOptions options = {}) {
  const double time = time_for_cutoff(cutoff * mean_edge_length(state.X, state.topology.E));
  options.total_time = time_in_flow_units(time, state.X, state.topology, options);
  return options;
}

std::vector<std::uint8_t> hold(const State& state) {
  return fixed_vertices(state.topology, BoundaryCondition::fixed);
}

Mesh shape(const char* name, int level) {
  ShapeSettings settings;
  settings.subdivide = level;
  return make_shape(name, settings);
}

/// Relative standard deviation of the distances from the centroid.
double radius_deviation(const Points& X) {
  const Eigen::RowVector3d centre = X.colwise().mean();
  const Eigen::VectorXd r = (X.rowwise() - centre).rowwise().norm();
  return std::sqrt((r.array() - r.mean()).square().mean()) / r.mean();
}

/// The parameters are the Laplacian, the cut-off in mean edge lengths, and the placement of the
/// meshes.
class GuardedFlow : public testing::TestWithParam<std::tuple<const char*, double, Placement>> {};

TEST_P(GuardedFlow, EnergyNeverRisesAndNothingFoldsOnAnyMesh) {
  const auto [laplacian, cutoff, placement] = GetParam();
  for (const auto& [name, mesh] : placed(all_meshes(), placement)) {
    SCOPED_TRACE(name);
    State state(mesh);
    state.X = shaken(state, 0.3);
    state.topology = build_topology(state.X, state.topology.F);
    if (state.topology.E.rows() == 0) {
      continue;
    }
    FlowOptions options;
    options.laplacian = laplacian;
    options.steps = 4;
    options = options_for(state, cutoff, options);
    const auto fixed = hold(state);
    const Unknowns unknowns(fixed);
    const FoldWatch folds(state.X, state.topology);
    Points X = state.X;
    const FlowReport report = willmore_flow(X, state.topology, fixed, options);
    EXPECT_TRUE(X.allFinite());
    EXPECT_TRUE(folds.new_folds(X).empty());
    double energy = report.energy_before;
    for (const StepRecord& step : report.steps) {
      EXPECT_LE(step.energy, energy);
      energy = step.energy;
    }
    EXPECT_LE(report.energy_after, report.energy_before);
    if (report.status == FlowStatus::completed && report.unknowns > 0) {
      EXPECT_NEAR(report.time_reached / options.total_time, 1, 1e-9);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Flow, GuardedFlow,
                         testing::Combine(testing::Values("crouzeix-raviart", "lagrange"),
                                          testing::Values(4.0, 40.0),
                                          testing::ValuesIn(all_placements)));

TEST(Flow, HeldVerticesKeepTheirBits) {
  for (const auto& [name, mesh] : all_meshes()) {
    const State state(mesh);
    std::vector<std::uint8_t> fixed = hold(state);
    for (std::size_t v = 0; v < fixed.size(); v += 4) {
      fixed[v] = 1;
    }
    for (const bool guarded : {true, false}) {
      FlowOptions options;
      options.steps = 2;
      options.guarded = guarded;
      options = options_for(state, 2, options);
      if (options.total_time <= 0) {
        continue;
      }
      Points X = state.X;
      willmore_flow(X, state.topology, fixed, options);
      for (std::size_t v = 0; v < fixed.size(); ++v) {
        if (fixed[v]) {
          EXPECT_EQ(X.row(v), state.X.row(v)) << name;
        }
      }
    }
  }
}

TEST(Flow, CleanInputTakesExactlyTheStepsAndOneFactorization) {
  for (const auto& [name, mesh] : closed_meshes()) {
    if (name.find("cube") != std::string::npos || name.find("hedron") != std::string::npos) {
      continue;  // all vertices of these meshes are corners: no part is clean
    }
    const State state(mesh);
    Points X = state.X;
    FlowOptions options = options_for(state, 4);
    options.solver = "multifrontal";
    const FlowReport report = willmore_flow(X, state.topology, hold(state), options);
    EXPECT_EQ(report.status, FlowStatus::completed) << name;
    EXPECT_EQ(report.steps.size(), 16U) << name;
    EXPECT_EQ(report.solves, 16) << name;
    EXPECT_EQ(report.factorizations, 1) << name;
  }
}

TEST(Flow, AFlatSheetIsDoneAtOnce) {
  const State state(flat_sheet(8, 8));
  for (const char* laplacian : {"crouzeix-raviart", "lagrange"}) {
    FlowOptions options;
    options.laplacian = laplacian;
    options = options_for(state, 8, options);
    Points X = state.X;
    const FlowReport report = willmore_flow(X, state.topology, hold(state), options);
    EXPECT_EQ(report.status, FlowStatus::completed) << laplacian;
    EXPECT_EQ(report.time_reached, options.total_time) << laplacian;
    EXPECT_EQ(X, state.X) << laplacian;
  }
}

TEST(Flow, DoesNotDependOnTheNumberOfThreads) {
  const State state(shape("icosphere", 4));
  State noisy = state;
  noisy.X = shaken(state, 0.3);
  for (const char* laplacian : {"crouzeix-raviart", "lagrange"}) {
    FlowOptions options;
    options.laplacian = laplacian;
    options = options_for(noisy, 8, options);
    Points one = noisy.X, two = noisy.X;
    set_thread_count(1);
    willmore_flow(one, noisy.topology, hold(noisy), options);
    set_thread_count(2);
    willmore_flow(two, noisy.topology, hold(noisy), options);
    set_thread_count(0);
    EXPECT_EQ(one, two) << laplacian;
  }
}

TEST(Flow, CommutesWithScalingAndRigidMotion) {
  const State state(shape("icosphere", 3));
  const Points noisy = shaken(state, 0.2);
  for (const Metric metric : {Metric::mass, Metric::identity}) {
    for (const bool mass : {true, false}) {
      FlowOptions options;
      options.metric = metric;
      options.mass = mass;
      options.steps = 4;
      const auto flow = [&](const Mesh& mesh) {
        const State moved_state(mesh);
        Points X = moved_state.X;
        willmore_flow(X, moved_state.topology, hold(moved_state),
                      options_for(moved_state, 6, options));
        return X;
      };
      const Mesh mesh = mesh_from_triangles(noisy, state.topology.F);
      const Points expected =
          moved(mesh_from_triangles(flow(mesh), state.topology.F), 1000, Vec3(10, 20, 30)).X;
      const Points X = flow(moved(mesh, 1000, Vec3(10, 20, 30)));
      EXPECT_LT((X - expected).cwiseAbs().maxCoeff(), 1e-7 * 1000);
    }
  }
}

TEST(Flow, RippleOfTheCutoffWavelengthDecaysByE) {
  // The law is du/dt = -Laplacian^2 u on a flat sheet, which defines the cut-off.
  const State state(flat_sheet(64, 64));
  const double wavelength = 0.25, height = 1e-4;
  Points X = state.X;
  X.col(2) = height * (2 * std::numbers::pi / wavelength * X.col(0).array()).sin();
  FlowOptions options;
  options.laplacian = "lagrange";
  options.relax = false;
  options.steps = 64;
  options.total_time = time_for_cutoff(wavelength);
  willmore_flow(X, state.topology, hold(state), options);
  // The height is measured in the middle of the sheet, a wavelength and more from the boundary,
  // which is fixed.
  double largest = 0;
  for (Eigen::Index v = 0; v < X.rows(); ++v) {
    const bool inside = (X.row(v).head(2).array() - 0.5).abs().maxCoeff() < 0.13;
    largest = inside ? std::max(largest, std::abs(X(v, 2))) : largest;
  }
  EXPECT_NEAR(largest / height, std::exp(-1), 0.02);
}

TEST(Flow, RoundSphereStaysAndFlatSheetStays) {
  const State sphere(shape("icosphere", 4));
  FlowOptions options;
  options.laplacian = "lagrange";
  Points X = sphere.X;
  willmore_flow(X, sphere.topology, hold(sphere), options_for(sphere, 20, options));
  EXPECT_LT(radius_deviation(X), 3e-4);
  EXPECT_NEAR(X.rowwise().norm().mean(), 1, 2e-3);
  const State sheet(flat_sheet(9, 7));
  X = sheet.X;
  willmore_flow(X, sheet.topology, hold(sheet), options_for(sheet, 20));
  EXPECT_LT(X.col(2).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(Flow, FlatIcosahedronBecomesASphere) {
  const State state(shape("icosahedron", 3));
  FlowOptions options;
  options.laplacian = "lagrange";
  options.steps = 8;
  Points X = state.X;
  const FlowReport report =
      willmore_flow(X, state.topology, hold(state), options_for(state, 20, options));
  EXPECT_LT(radius_deviation(X), 4e-4);
  EXPECT_LE(report.solves, 12);
}

TEST(Flow, PublishedSchemeRisesWhereTheGuardedOneDoesNot) {
  const State state(shape("icosahedron", 4));
  FlowOptions options;
  options.guarded = false;
  options.metric = Metric::identity;
  options.steps = 10;
  options.total_time = 10 * 0.1;
  Points X = state.X;
  const FlowReport plain = willmore_flow(X, state.topology, hold(state), options);
  EXPECT_EQ(plain.factorizations, 1);
  EXPECT_EQ(plain.solves, 10);
  EXPECT_NEAR(radius_deviation(X), 1.2e-3, 1e-4);
  bool rose = false;
  for (std::size_t k = 1; k < plain.steps.size(); ++k) {
    rose = rose || plain.steps[k].energy > plain.steps[k - 1].energy;
  }
  EXPECT_TRUE(rose);
}

TEST(Flow, MoreNewtonIterationsSolveTheStepBetter) {
  // One large step: the residual D d + h grad E(X + d) shrinks with the iterations.
  const State state(shape("icosphere", 3));
  const Points start = shaken(state, 0.05);
  const auto residual = [&](int iterations) {
    FlowOptions options;
    options.laplacian = "lagrange";
    options.guarded = false;
    options.steps = 1;
    options.newton_iterations = iterations;
    options = options_for(state, 3, options);
    Points X = start, G;
    willmore_flow(X, state.topology, hold(state), options);
    bending_model("lagrange").create(state.topology, {})->energy_and_gradient(X, G);
    const PerVertex D = lumped_vertex_mass(start, state.topology);
    return (D.asDiagonal() * (X - start) + options.total_time * G).norm();
  };
  const double one = residual(1), three = residual(3), six = residual(6);
  EXPECT_LT(three, 0.3 * one);
  EXPECT_LT(six, 0.3 * three);
}

TEST(Flow, MaxMoveIsHeldFarFromTheOriginToo) {
  State state(shape("icosahedron", 3));
  for (const auto& [guarded, away] :
       {std::pair(true, 0.0), std::pair(false, 0.0), std::pair(true, 5e6)}) {
    state.X.array() += away;
    FlowOptions options;
    options.guarded = guarded;
    options.steps = 6;
    options = options_for(state, guarded ? 20 : 8, options);
    options.max_move = 0.01;
    Points X = state.X;
    willmore_flow(X, state.topology, hold(state), options);
    const double largest = (X - state.X).rowwise().norm().maxCoeff();
    EXPECT_LE(largest, 0.01);
    EXPECT_GT(largest, 0.009);
  }
}

/// A sphere whose triangles shrink toward a pole; the higher the power, the more they shrink.
State drawn_to_pole(const State& sphere, double power) {
  constexpr double radius = 0.6;  // of the part that shrinks, in radians
  State drawn = sphere;
  for (auto x : drawn.X.rowwise()) {
    const double angle = std::acos(std::clamp(x[2], -1.0, 1.0));
    if (angle > 0 && angle < radius) {
      const double nearer = radius * std::pow(angle / radius, power);
      x.head<2>() *= std::sin(nearer) / std::sin(angle);
      x[2] = std::cos(nearer);
    }
  }
  return drawn;
}

FlowReport flow_by(const State& state, const char* laplacian, double cutoff, const char* solver) {
  FlowOptions options;
  options.laplacian = laplacian;
  options.solver = solver;
  Points X = shaken(state, 0.02);
  return willmore_flow(X, state.topology, hold(state), options_for(state, cutoff, options));
}

/// Reports of the same flow with the solver chosen automatically and with conjugate gradients.
struct OpenAndIterative {
  FlowReport open, iterative;
};

OpenAndIterative expect_a_factor(const State& state, const char* laplacian, double cutoff) {
  SCOPED_TRACE(laplacian);
  OpenAndIterative runs{flow_by(state, laplacian, cutoff, "auto"),
                        flow_by(state, laplacian, cutoff, "cg")};
  EXPECT_EQ(runs.open.solver, "multifrontal");
  EXPECT_GT(runs.open.factorizations, 0);
  EXPECT_EQ(runs.open.status, FlowStatus::completed);
  EXPECT_NEAR(runs.open.energy_after / runs.iterative.energy_after, 1, 0.05);
  return runs;
}

/// If triangles vary in size, conjugate gradients need many more iterations than most of the mesh
/// suggests. The flow then factors the matrix instead.
TEST(Flow, FactorsWhereIterationsTurnOutToBeMany) {
  const State regular(shape("icosphere", 4)), drawn = drawn_to_pole(regular, 2);
  for (const char* laplacian : {"lagrange", "crouzeix-raviart"}) {
    const auto [mixed, iterative] = expect_a_factor(drawn, laplacian, 12);
    EXPECT_GT(mixed.iterations, 0) << laplacian;
    EXPECT_LT(mixed.iterations, iterative.iterations / 3) << laplacian;
    EXPECT_EQ(flow_by(regular, laplacian, 8, "auto").factorizations, 0) << laplacian;
  }
}

/// If there are needles, conjugate gradients also need many more iterations. The flow detects
/// needles beforehand and factors at once.
TEST(Flow, FactorsAtOnceWhereThereAreNeedles) {
  const State regular(shape("icosphere", 4)), needles = drawn_to_pole(regular, 4);
  for (const char* laplacian : {"lagrange", "crouzeix-raviart"}) {
    const auto [direct, iterative] = expect_a_factor(needles, laplacian, 4);
    EXPECT_EQ(direct.iterations, 0) << laplacian;
    const FlowReport without_needles = flow_by(regular, laplacian, 4, "auto");
    EXPECT_EQ(without_needles.solver, "cg") << laplacian;
    EXPECT_GT(iterative.iterations, 4 * without_needles.iterations) << laplacian;
  }
}

/// Isolated triangles have no energy. They do not count as needles compared with the rest of the
/// mesh, nor does the rest of the mesh count as needles compared with them.
TEST(Flow, IteratesAsBeforeBesideTrianglesApart) {
  const State sphere(shape("icosphere", 4));
  const Index shared = sphere.topology.vertex_count, apart = 2 * shared;
  const double edge = mean_edge_length(sphere.X, sphere.topology.E);
  Points X(shared + 3 * apart, 3);
  Triangles F(sphere.topology.F.rows() + apart, 3);
  X.topRows(shared) = sphere.X;
  F.topRows(sphere.topology.F.rows()) = sphere.topology.F;
  for (Index i = 0; i < apart; ++i) {
    const Index first = shared + 3 * i;
    for (int corner = 0; corner < 3; ++corner) {
      X.row(first + corner) = edge * Vec3(2 * i + corner % 2, corner == 2 ? 1 : 0, 5 / edge);
    }
    F.row(F.rows() - 1 - i) << first, first + 1, first + 2;
  }
  const State all(mesh_from_triangles(X, F));
  const std::vector<std::uint8_t> nothing_held(static_cast<std::size_t>(X.rows()), 0);
  const FlowReport beside = willmore_flow(X, all.topology, nothing_held, options_for(all, 4));
  EXPECT_EQ(beside.solver, "cg");
  EXPECT_EQ(beside.factorizations, 0);
  EXPECT_GT(beside.iterations, 0);
}

TEST(Flow, ObserverCanStopIt) {
  const State state(shape("icosphere", 2));
  Points X = shaken(state, 0.1);
  const FlowReport report = willmore_flow(X, state.topology, hold(state), options_for(state, 4),
                                          [](const StepRecord& step) { return step.step < 3; });
  EXPECT_EQ(report.status, FlowStatus::interrupted);
  EXPECT_EQ(report.steps.size(), 3U);
}

TEST(Flow, RefusesWhatCannotBe) {
  const State state(shape("icosphere", 1));
  Points X = state.X;
  const auto fixed = hold(state);
  FlowOptions options = options_for(state, 4);
  options.steps = 0;
  EXPECT_THROW(willmore_flow(X, state.topology, fixed, options), BadOption);
  options = options_for(state, 4);
  options.total_time = std::nan("");
  EXPECT_THROW(willmore_flow(X, state.topology, fixed, options), BadOption);
  X(3, 1) = std::numeric_limits<double>::infinity();
  EXPECT_THROW(willmore_flow(X, state.topology, fixed, options_for(state, 4)), BadMesh);
}

TEST(FixedVertices, KeepTwoRingsOneOrNone) {
  const State state(flat_sheet(8, 8));
  const auto count = [&](BoundaryCondition condition) {
    const auto fixed = fixed_vertices(state.topology, condition);
    return std::count(fixed.begin(), fixed.end(), 1);
  };
  EXPECT_EQ(count(BoundaryCondition::free), 0);
  EXPECT_EQ(count(BoundaryCondition::position), 32);
  EXPECT_EQ(count(BoundaryCondition::fixed), 32 + 24);
}

TEST(FixedVertices, IncludeEveryDefect) {
  for (const auto& [name, mesh] : defective_meshes()) {
    const State state(mesh);
    const auto fixed = fixed_vertices(state.topology, BoundaryCondition::free);
    for (std::size_t v = 0; v < fixed.size(); ++v) {
      EXPECT_GE(fixed[v], state.topology.defective[v]) << name;
    }
  }
}

}  // namespace
}  // namespace ibmfair::test
