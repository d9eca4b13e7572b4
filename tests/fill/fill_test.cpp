// Finding holes, filling them, and fairing regions of a mesh.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/threads.h"
#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/mass_matrices.h"
#include "ibmfair/fill/fill_holes.h"
#include "ibmfair/fill/fill_region.h"
#include "ibmfair/fill/harmonic_extension.h"
#include "ibmfair/fill/intersections.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/shapes/shapes.h"
#include "support/holed_meshes.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

/// The mesh with its filling appended.
Mesh closed_up(const State& state, const Filling& filling) {
  FilledMesh filled = filled_mesh(state.topology, filling);
  return mesh_from_triangles(std::move(filled.X), filled.F);
}

Filling fill_all(const State& state, const FillOptions& options = {}) {
  HoleChoice choice;
  choice.all = true;
  return fill_holes(state.X, state.topology, choice, options);
}

State icosphere_without_cap(int level, double degrees) {
  return State(without_cap(sphere(level), degrees));
}

TEST(Holes, SheetsHaveOuterBordersAndClosedSurfacesHaveHoles) {
  const State sheet(flat_sheet(6, 6));
  const auto borders = find_holes(sheet.X, sheet.topology);
  ASSERT_EQ(borders.size(), 1u);
  EXPECT_TRUE(borders[0].outer_border);
  EXPECT_NEAR(borders[0].border_share, 1, 1e-12);
  EXPECT_NEAR(borders[0].perimeter, 4, 1e-12);
  EXPECT_NEAR(borders[0].diameter, std::sqrt(2.0), 1e-12);
  EXPECT_EQ(borders[0].edges(), 24);

  const State half = icosphere_without_cap(3, 90);
  const auto hole = find_holes(half.X, half.topology);
  ASSERT_EQ(hole.size(), 1u);
  EXPECT_FALSE(hole[0].outer_border);
  EXPECT_NEAR(hole[0].border_share, 0.5, 0.1);
}

TEST(Holes, OnlyTheLongestLoopOfAComponentIsABorder) {
  for (const auto& [name, mesh] : open_meshes()) {
    SCOPED_TRACE(name);
    const State state(mesh);
    std::set<Index> components;
    for (const Hole& hole : find_holes(state.X, state.topology)) {
      EXPECT_TRUE(!hole.outer_border || components.insert(hole.component).second);
    }
  }
}

TEST(Holes, ChoiceSaysWhy) {
  const State state(without_triangles(sphere(2), {0, 100}));
  const auto holes = find_holes(state.X, state.topology);
  ASSERT_EQ(holes.size(), 2u);
  HoleChoice choice;
  EXPECT_EQ(reason_to_skip(holes[0], choice), "");
  choice.most_edges = 2;
  EXPECT_NE(reason_to_skip(holes[0], choice), "");
  choice = {};
  choice.longest_perimeter = holes[0].perimeter * 0.99;
  EXPECT_NE(reason_to_skip(holes[0], choice), "");
  choice = {};
  choice.only = {1};
  EXPECT_NE(reason_to_skip(holes[0], choice), "");
  EXPECT_EQ(reason_to_skip(holes[1], choice), "");
  choice.only = {2};
  EXPECT_THROW(require_known_holes(holes, choice), BadOption);
}

TEST(Holes, LoopsThatMeetAVertexTwiceAreSplitThere) {
  using Loops = std::vector<std::vector<Index>>;
  EXPECT_EQ(simple_loops({0, 1, 2}), (Loops{{0, 1, 2}}));
  EXPECT_EQ(simple_loops({0, 1, 2, 0, 3, 4}), (Loops{{0, 1, 2}, {0, 3, 4}}));
  EXPECT_EQ(simple_loops({5, 0, 1, 2, 0, 3, 4}), (Loops{{0, 1, 2}, {5, 0, 3, 4}}));
  EXPECT_EQ(simple_loops({0, 1, 2, 3, 1, 4, 5}), (Loops{{1, 2, 3}, {0, 1, 4, 5}}));
}

TEST(Fill, ClosesEveryOpenMeshWithoutTouchingIt) {
  for (const auto& [name, mesh] : holed_meshes()) {
    SCOPED_TRACE(name);
    const State state(mesh);
    ASSERT_GT(state.topology.boundary_loops.size(), 0u);
    const Filling filling = fill_all(state);
    EXPECT_EQ(filling.X, state.X);
    const State closed(closed_up(state, filling));
    EXPECT_EQ(closed.topology.boundary_loops.size(), 0u);
    EXPECT_TRUE(closed.topology.defects.empty());
    EXPECT_EQ(closed.topology.turned_triangles, 0);
    for (const HoleReport& hole : filling.holes) {
      EXPECT_EQ(hole.status, HoleStatus::filled) << hole.reason;
      EXPECT_EQ(hole.seam.folds, 0);
      EXPECT_EQ(hole.intersections, 0);
    }
    EXPECT_EQ(filling.model_triangle.size(), static_cast<std::size_t>(filling.new_F.rows()));
  }
}

TEST(Fill, SameBytesForAnyNumberOfThreadsAndEveryTime) {
  const State state(with_many_holes(sphere(4)));
  ASSERT_GT(state.topology.boundary_loops.size(), 10u);
  set_thread_count(1);
  const Filling one = fill_all(state);
  for (const int threads : {1, 2, 2}) {
    set_thread_count(threads);
    const Filling again = fill_all(state);
    EXPECT_EQ(again.new_X, one.new_X);
    EXPECT_EQ(again.new_F, one.new_F);
  }
}

/// Allocates memory of many sizes and frees half of it again, so that later allocations lie at
/// scattered addresses.
std::vector<std::vector<char>> scattered_heap(unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::vector<char>> blocks;
  for (int i = 0; i < 400; ++i) {
    blocks.emplace_back(random() % 8000);
  }
  std::shuffle(blocks.begin(), blocks.end(), random);
  blocks.resize(200);
  return blocks;
}

/// On a surface as regular as this torus, some triangulations of a hole are equally good to the
/// last bit.
TEST(Fill, SameTrianglesWhereverMemoryLies) {
  const State torus(make_shape("torus", {.ratio = 2.5, .rows = 48, .columns = 120}));
  std::vector<Index> middles;
  for (Index v = 0; v < torus.topology.vertex_count; v += 501) {
    middles.push_back(v);
  }
  const std::vector<std::uint8_t> near = around(torus.topology, middles, 4);
  std::vector<Index> cut;
  for (Index t = 0; t < torus.topology.F.rows(); ++t) {
    const auto corners = torus.topology.F.row(t);
    if (std::ranges::any_of(corners, [&](Index v) { return near[v] != 0; })) {
      cut.push_back(t);
    }
  }
  const State holed(without_triangles(mesh_from_triangles(torus.X, torus.topology.F), cut));
  ASSERT_GE(holed.topology.boundary_loops.size(), 8u);
  FillOptions options;
  options.refine = options.fair = false;
  const Filling expected = fill_all(holed, options);
  for (unsigned seed = 1; seed <= 30; ++seed) {
    const auto blocks = scattered_heap(seed);
    const Filling again = fill_all(holed, options);
    ASSERT_EQ(again.new_F, expected.new_F) << blocks.size() << " blocks, seed " << seed;
  }
}

TEST(Fill, DoesNotDependOnScaleOrPlace) {
  const Mesh mesh = without_cap(sphere(3), 40);
  const State state(mesh);
  const Points patch = fill_all(state).new_X;
  for (const double scale : {1e-6, 1e6}) {
    const State other(moved(mesh, scale, Vec3(scale, 0, -scale)));
    const Points expected = moved({patch, {}}, scale, Vec3(scale, 0, -scale)).X;
    const Points found = fill_all(other).new_X;
    ASSERT_EQ(found.rows(), expected.rows());
    EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-5 * scale);
  }
}

TEST(Fill, AFlatHoleStaysFlat) {
  const State state(with_square_hole(flat_sheet(12, 12), 3));
  HoleChoice choice;
  const Filling filling = fill_holes(state.X, state.topology, choice, {});
  ASSERT_GT(filling.new_X.rows(), 0);
  EXPECT_LT(filling.new_X.col(2).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(
      std::count_if(filling.holes.begin(), filling.holes.end(),
                    [](const HoleReport& hole) { return hole.status == HoleStatus::skipped; }),
      1);  // the outer border
  EXPECT_NEAR(
      surface_area(closed_up(state, filling).X, State(closed_up(state, filling)).topology.F), 1,
      1e-12);
}

/// In a plane that is not parallel to an axis, the gradient consists of rounding errors.
TEST(Fill, AFlatHoleInAnyPlaneIsFilledWell) {
  const Mesh sheet = with_square_hole(flat_sheet(12, 12), 3);
  for (const auto& [scale, distance] :
       {std::pair{1e-8, 1.0}, std::pair{1.0, 1.0}, std::pair{1e8, 1.0}, std::pair{1.0, 1e5}}) {
    const Vec3 offset = scale * distance * Vec3(1, -2, 3);
    const State state(moved(sheet, scale, offset));
    const Vec3 normal =
        moved(mesh_from_triangles(Points(Vec3(0, 0, 1).transpose()), {}), 1, Vec3::Zero()).X.row(0);
    for (const BendingModel& model : bending_models()) {
      SCOPED_TRACE(std::string(model.name));
      FillOptions options;
      options.fairing.laplacian = model.name;
      const Filling filling = fill_holes(state.X, state.topology, {}, options);
      ASSERT_GT(filling.new_X.rows(), 0);
      EXPECT_EQ(filling.holes[1].status, HoleStatus::filled) << filling.holes[1].reason;
      EXPECT_TRUE(model.evens_edges || filling.holes[1].method == model.name);
      const Eigen::VectorXd height = (filling.new_X.rowwise() - offset.transpose()) * normal;
      EXPECT_LT(height.cwiseAbs().maxCoeff(), 1e-12 * scale * distance);
    }
  }
}

/// Spheres are stationary: the patch must be the cap that was cut out. The test bounds the largest
/// radial error in units of the cap's height, with 2562 vertices on the whole sphere.
TEST(Fill, SphericalCapsComeBack) {
  for (const double degrees : {20.0, 45.0, 90.0}) {
    SCOPED_TRACE(degrees);
    const State state = icosphere_without_cap(4, degrees);
    const Filling filling = fill_all(state);
    ASSERT_EQ(filling.holes.size(), 1u);
    EXPECT_EQ(filling.holes[0].status, HoleStatus::filled);
    const double height = 1 - std::cos(degrees * std::numbers::pi / 180);
    const double error = (filling.new_X.rowwise().norm().array() - 1).abs().maxCoeff();
    EXPECT_LT(error, 0.015 * height);
  }
}

TEST(Fill, EveryLaplacianBringsTheCapToTheEnd) {
  const State state = icosphere_without_cap(4, 20);
  for (const BendingModel& model : bending_models()) {
    FillOptions options;
    options.fairing.laplacian = model.name;
    const Filling filling = fill_all(state, options);
    EXPECT_EQ(filling.holes[0].status, HoleStatus::filled) << model.name;
    // Times in units of the flow belong to an energy whose mass matrix measures area.
    const FlowOptions flow = options.fairing.flow_options();
    EXPECT_TRUE(mass_matrix(model, flow.energy_options()).measures_area()) << model.name;
  }
}

TEST(Fill, RefinesToTheLengthOfTheRim) {
  const State state(with_square_hole(flat_sheet(24, 24), 8));
  FillOptions options;
  options.fair = false;
  const Filling filling = fill_holes(state.X, state.topology, {}, options);
  const State patch(mesh_from_triangles(closed_up(state, filling).X, filling.new_F));
  const double mean = mean_edge_length(patch.X, patch.topology.E);
  EXPECT_NEAR(mean, 1.0 / 24, 0.2 / 24);
  EXPECT_GT(smallest_angle(patch.X, filling.new_F), 0.3);

  options.refine = false;
  EXPECT_EQ(fill_holes(state.X, state.topology, {}, options).new_X.rows(), 0);
}

TEST(Fill, GrowthIsBounded) {
  const State state = icosphere_without_cap(4, 60);
  FillOptions options;
  options.most_new_vertices = 50;
  const Filling filling = fill_all(state, options);
  EXPECT_LE(filling.new_X.rows(), 50);
  EXPECT_EQ(filling.holes[0].status, HoleStatus::coarse);
  EXPECT_EQ(State(closed_up(state, filling)).topology.boundary_loops.size(), 0u);
}

TEST(Fill, ASingleTriangleIsNotCoveredTwice) {
  Points X(3, 3);
  X << 0, 0, 0, 1, 0, 0, 0, 1, 0;
  const Triangles F{{0, 1, 2}};
  const State state(mesh_from_triangles(X, F));
  EXPECT_EQ(fill_holes(state.X, state.topology, {}, {}).holes[0].status, HoleStatus::skipped);
  const Filling filling = fill_all(state);
  EXPECT_EQ(filling.holes[0].status, HoleStatus::failed);
  EXPECT_NE(filling.holes[0].reason, "");
  EXPECT_EQ(filling.new_F.rows(), 0);
}

TEST(Fill, ALoopThatEndsAtANonManifoldEdgeIsLeftWithTheReason) {
  for (const auto& [name, mesh] : defective_meshes()) {
    SCOPED_TRACE(name);
    const State state(mesh);
    const Filling filling = fill_all(state);
    EXPECT_EQ(filling.X, state.X);
    for (const HoleReport& hole : filling.holes) {
      EXPECT_TRUE(hole.status == HoleStatus::filled || !hole.reason.empty());
      EXPECT_EQ(hole.status == HoleStatus::failed, hole.new_triangles == 0);
    }
  }
}

TEST(Fill, AnIslandIsJoinedIfItLiesInTheSurface) {
  for (const double lift : {0.0, 0.3}) {
    SCOPED_TRACE(lift);
    const State state(with_island(sphere(4), lift));
    const Filling filling = fill_holes(state.X, state.topology, {}, {});
    ASSERT_EQ(filling.holes.size(), 2U);
    EXPECT_EQ(filling.holes[0].status, HoleStatus::filled);
    EXPECT_EQ(filling.holes[0].intersections, 0);
    EXPECT_EQ(filling.holes[1].status, lift == 0 ? HoleStatus::filled : HoleStatus::skipped);
    const State filled(closed_up(state, filling));
    EXPECT_EQ(filled.topology.boundary_loops.size(), lift == 0 ? 0u : 1u);
    EXPECT_EQ(filled.topology.component_count, lift == 0 ? 1 : 2);
    if (lift == 0) {
      EXPECT_LT((filling.new_X.rowwise().norm().array() - 1).abs().maxCoeff(), 0.002);
    }
  }
}

TEST(Fill, ARoughRimIsSmoothedWithTheRingsThatMayMove) {
  Mesh mesh = without_cap(sphere(4), 45);
  State state(mesh);
  // Push the rim's vertices up and down in turn.
  const auto loop = find_holes(state.X, state.topology)[0].loop;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    state.X.row(loop[i]) *= i % 2 == 0 ? 1.01 : 0.99;
  }
  const auto error = [](const Filling& filling) {
    return (filling.new_X.rowwise().norm().array() - 1).abs().mean();
  };
  FillOptions options;
  const Filling rough = fill_all(state, options);
  options.rim_smooth = 2;
  const Filling smooth = fill_all(state, options);
  EXPECT_LT(error(smooth), 0.3 * error(rough));
  Index moved = 0;
  for (Index v = 0; v < state.topology.vertex_count; ++v) {
    moved += smooth.X.row(v) != state.X.row(v) ? 1 : 0;
  }
  EXPECT_GT(moved, static_cast<Index>(loop.size()));
  EXPECT_LT(moved, 4 * static_cast<Index>(loop.size()));
}

TEST(FillRegion, AFlattenedCapBecomesRoundAgain) {
  State state(sphere(4));
  std::vector<std::uint8_t> region(static_cast<std::size_t>(state.X.rows()), 0);
  const double low = std::cos(std::numbers::pi / 4);
  for (Index v = 0; v < state.topology.vertex_count; ++v) {
    if (state.X(v, 2) > low) {
      region[v] = 1;
      state.X(v, 2) = low;
    }
  }
  const Points before = state.X;
  const RegionReport report = fair_region(state.X, state.topology, region, {});
  EXPECT_TRUE(report.fairing.converged);
  EXPECT_EQ(report.folds, 0);
  for (Index v = 0; v < state.topology.vertex_count; ++v) {
    if (!region[v]) {
      ASSERT_EQ(state.X.row(v), before.row(v));
    }
  }
  EXPECT_LT((state.X.rowwise().norm().array() - 1).abs().maxCoeff(), 0.01 * (1 - low));
  EXPECT_THROW(
      fair_region(state.X, state.topology, std::vector<std::uint8_t>(region.size(), 0), {}),
      BadOption);
}

TEST(FillRegion, EvensOutIfAsked) {
  const State state(sphere(4));
  std::vector<std::uint8_t> region(static_cast<std::size_t>(state.X.rows()), 0);
  Points X = shaken(state, 0.25);
  for (Index v = 0; v < state.topology.vertex_count; ++v) {
    region[v] = state.X(v, 2) > 0.7 ? 1 : 0;
    if (!region[v]) {
      X.row(v) = state.X.row(v);
    }
  }
  Points as_it_is = X, relaxed = X;
  FairingOptions options;
  EXPECT_TRUE(fair_region(as_it_is, state.topology, region, options).fairing.converged);
  options.relax = true;
  EXPECT_TRUE(fair_region(relaxed, state.topology, region, options).fairing.converged);
  const auto unevenness = [&](const Points& Y) {
    return (triangle_areas(Y, state.topology.F) - triangle_areas(state.X, state.topology.F)).norm();
  };
  EXPECT_LT(unevenness(relaxed), 0.5 * unevenness(as_it_is));
  EXPECT_LT((relaxed.rowwise().norm().array() - 1).abs().maxCoeff(), 0.003);
  for (Index v = 0; v < state.topology.vertex_count; ++v) {
    ASSERT_TRUE(region[v] || relaxed.row(v) == state.X.row(v));
  }
}

TEST(HarmonicExtension, KeepsConstantsAndTheRangeOfTheRim) {
  const State state = icosphere_without_cap(3, 60);
  const Filling filling = fill_all(state);
  const std::vector<Index> rim = filling.rim();
  Eigen::MatrixXd values(static_cast<Eigen::Index>(rim.size()), 5);
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    values.row(i) << 1, state.X(rim[i], 0), state.X(rim[i], 1), std::sin(double(i)), -2;
  }
  const Eigen::MatrixXd extended = filling.extend(values);
  ASSERT_EQ(extended.rows(), filling.new_X.rows());
  EXPECT_LT((extended.col(0).array() - 1).abs().maxCoeff(), 1e-12);
  EXPECT_LT((extended.col(4).array() + 2).abs().maxCoeff(), 1e-12);
  for (const int column : {1, 2, 3}) {
    EXPECT_GE(extended.col(column).minCoeff(), values.col(column).minCoeff());
    EXPECT_LE(extended.col(column).maxCoeff(), values.col(column).maxCoeff());
    EXPECT_GT(extended.col(column).maxCoeff() - extended.col(column).minCoeff(), 0.05);
  }
}

TEST(Intersections, CrossingsAreFoundAndNeighboursAreNot) {
  Points X(6, 3);
  X << 0, 0, 0, 2, 0, 0, 0, 2, 0, 0.3, 0.3, -1, 0.3, 0.3, 1, 3, 3, 0;
  const Triangles crossing{{0, 1, 2}, {3, 4, 5}};
  EXPECT_EQ(patch_intersections(X, crossing, 1).size(), 1u);
  EXPECT_EQ(patch_intersections(X, crossing, 2).size(), 0u);  // neither triangle is in a patch
  const Triangles apart{{0, 1, 2}, {1, 2, 5}};
  EXPECT_EQ(patch_intersections(X, apart, 1).size(), 0u);
  const Triangles through_a_shared_corner{{0, 1, 2}, {0, 4, 5}};
  X.row(4) << 1, 1, 1;
  X.row(5) << 1, 0.5, -1;
  EXPECT_EQ(patch_intersections(X, through_a_shared_corner, 1).size(), 1u);
}

}  // namespace
}  // namespace ibmfair::test
