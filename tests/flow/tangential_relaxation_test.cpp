// A sweep of tangential relaxation moves vertices within the surface. It moves vertices off the
// surface only if noise left spikes and foldovers, which the energy does not turn back.
#include "ibmfair/flow/steps/tangential_relaxation.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "ibmfair/mesh/geometry.h"
#include "ibmfair/shapes/shapes.h"
#include "support/flow_run.h"
#include "support/states.h"
#include "support/thin_states.h"

namespace ibmfair::test {
namespace {

Points sweep(const State& state, bool keeps_creases) {
  const auto fixed = fixed_vertices(state.topology, BoundaryCondition::fixed);
  FlowOptions options;
  options.sharp_angle = keeps_creases ? 0.5 : 0;
  const FlowProblem problem(state.X, state.topology, fixed, options, MeshParts::one());
  const Unknowns& unknowns = problem.unknowns;
  const CompressedRows rings = vertex_rings(state.topology);
  const RingGroups groups(state.topology, rings, unknowns);
  TangentialRelaxation relaxation(problem, groups);
  Points move, by_vertex = Points::Zero(state.X.rows(), 3);
  relaxation.moves(state.X, move);
  for (Index u = 0; u < unknowns.size(); ++u) {
    by_vertex.row(unknowns.vertex[u]) = move.row(u);
  }
  return by_vertex;
}

State made(const std::string& shape) {
  const bool rolled = shape == "torus" || shape == "catenoid";
  return State(rolled             ? make_shape(shape, {.rows = 24, .columns = 40})
               : shape == "plane" ? make_shape(shape, {.rows = 25, .columns = 40})
                                  : make_shape(shape, {.subdivide = 4}));
}

TEST(TangentialRelaxation, StaysWithinSurfacesThatAreSmoothOrThin) {
  for (const State& state :
       {made("icosphere"), made("torus"), made("catenoid"), made("plane"), wedge(20 * degree),
        wedge(60 * degree), wedge(90 * degree), needle(20 * degree)}) {
    const Points move = sweep(state, false);
    const double edge = mean_edge_length(state.X, state.topology.E);
    for (Index v = 0; v < state.X.rows(); ++v) {
      const Vec3 normal = double_area_vector_at(v, state.X, state.topology).normalized();
      EXPECT_LT(std::abs(move.row(v).dot(normal)), 1e-12 * edge) << v;
    }
  }
}

/// A cube whose vertices lie at uneven positions on the faces, edges and corners that they belong
/// to.
State uneven_cube() {
  State cube = made("cube");
  for (double& x : cube.X.reshaped()) {
    x += 0.02 * (1 - x * x) * std::sin(100 * x);  // keeps coordinates of -1 and 1
  }
  const Points even = cube.X;
  for (Index v = 0; v < cube.X.rows(); ++v) {
    for (int i = 0; i < 3; ++i) {
      const double free = 1 - std::pow(even(v, i), 2), along = even.row(v).dot(Vec3(7, 11, 13));
      cube.X(v, i) += 0.02 * free * std::sin(50 * along);
    }
  }
  return cube;
}

TEST(TangentialRelaxation, MovesNothingOffSharpCreasesWhereTheyAreKept) {
  const State cube = uneven_cube();
  const auto off_surface = [&](const Points& move) {
    return ((cube.X + move).rowwise().lpNorm<Eigen::Infinity>().array() - 1).abs().maxCoeff();
  };
  const Points kept = sweep(cube, true), rounded = sweep(cube, false);
  const double edge = mean_edge_length(cube.X, cube.topology.E);
  EXPECT_LT(off_surface(kept), 1e-6 * edge);
  EXPECT_GT(off_surface(rounded), 0.01 * edge);
  for (Index v = 0; v < cube.X.rows(); ++v) {
    const auto on_faces = (cube.X.row(v).array().abs() == 1).count();
    EXPECT_EQ(kept.row(v).norm() > 1e-6 * edge, on_faces < 3) << "vertex " << v;  // edges slide
    if (on_faces == 1) {
      EXPECT_LT((kept.row(v) - rounded.row(v)).norm(), 1e-6 * edge) << "vertex " << v;
    }
  }
}

TEST(TangentialRelaxation, SeesNoCreasesInFineSmoothSurfaces) {
  for (const char* shape : {"icosphere", "torus", "catenoid"}) {
    const State state = made(shape);
    const Points kept = sweep(state, true), all = sweep(state, false);
    EXPECT_LT((kept - all).norm(), 0.1 * all.norm()) << shape;
  }
}

TEST(TangentialRelaxation, LaysSpikesDown) {
  const State state = made("torus");
  const double edge = mean_edge_length(state.X, state.topology.E);
  const CompressedRows rings = vertex_rings(state.topology);
  for (const double height : {-3.0, 2.0, 4.0}) {
    State spiky = state;
    const Index v = 100;
    const Vec3 normal = double_area_vector_at(v, state.X, state.topology).normalized();
    spiky.X.row(v) += height * edge * normal.transpose();
    Vec3 mean = Vec3::Zero();
    for (const Index q : rings[v]) {
      mean += spiky.X.row(q).transpose() / static_cast<double>(rings[v].size());
    }
    const Vec3 half_way = (mean - spiky.X.row(v).transpose()) / 2;
    EXPECT_LT((sweep(spiky, false).row(v).transpose() - half_way).norm(), 1e-12 * edge);
    const Vec3 own_normal = double_area_vector_at(v, spiky.X, state.topology).normalized();
    EXPECT_LT(std::abs(sweep(spiky, true).row(v).dot(own_normal)), 1e-12 * edge);
  }
}

TEST(TangentialRelaxation, FindsTheCornersOfNeedlesAlone) {
  for (const char* shape : {"icosphere", "torus"}) {
    State state = made(shape);
    const auto fixed = fixed_vertices(state.topology, BoundaryCondition::fixed);
    const FlowOptions options;
    const FlowProblem problem(state.X, state.topology, fixed, options, MeshParts::one());
    const CompressedRows rings = vertex_rings(state.topology);
    const RingGroups groups(state.topology, rings, problem.unknowns);
    TangentialRelaxation relaxation(problem, groups);
    Points all, move;
    EXPECT_FALSE(relaxation.moves_at_needles(state.X, move)) << shape;
    const Index triangle = 50;
    state.X = with_needle(state, triangle, 0.003);
    ASSERT_TRUE(relaxation.moves_at_needles(state.X, move)) << shape;
    relaxation.moves(state.X, all);
    for (Index v = 0; v < state.X.rows(); ++v) {
      const bool at_needle = (state.topology.F.row(triangle).array() == v).any();
      EXPECT_TRUE(move.row(v) == (at_needle ? Vec3(all.row(v)) : Vec3(Vec3::Zero())).transpose())
          << shape << ", vertex " << v;
    }
  }
}

TEST(TangentialRelaxation, KeepsNeedlesFromMagnifyingRounding) {
  for (const char* shape : {"icosphere", "torus"}) {
    for (const bool keep_volume : {false, true}) {
      State state = made(shape);
      state.X = shaken(state, 0.2);
      for (const Index triangle : {50, 333, 700}) {
        state.X = with_needle(state, triangle, 1e-9);
      }
      State rounded = state;
      rounded.X = rounded.X.unaryExpr([](double x) { return std::nextafter(x, 2 * x); });
      FlowOptions options;
      options.keep_volume = keep_volume;
      options.solver_tolerance = 1e-12;
      const FlowRun one = run_flow(state, 6, options), other = run_flow(rounded, 6, options);
      EXPECT_EQ(one.report.status, FlowStatus::completed) << shape;
      EXPECT_LT((one.X - other.X).cwiseAbs().maxCoeff(), 1e-9) << shape;
      const Triangles& F = state.topology.F;
      const double change = enclosed_volume(one.X, F) / enclosed_volume(state.X, F) - 1;
      EXPECT_EQ(std::abs(change) < 1e-12, keep_volume) << shape << ": " << change;
    }
  }
}

TEST(TangentialRelaxation, LetsNoFlapsOfNoiseSurviveTheFlow) {
  for (const char* shape : {"icosphere", "torus"}) {
    State state = made(shape);
    state.X = shaken(state, 0.5);
    const auto folds = [&](const Points& X) {
      return (dihedral_angles(X, state.topology.H).array() < 90 * degree).count();
    };
    EXPECT_GT(folds(state.X), state.topology.H.rows() / 50) << shape;
    EXPECT_EQ(folds(run_flow(state, 4, {}).X), 0) << shape;
  }
}

}  // namespace
}  // namespace ibmfair::test
