// A flow renumbers meshes whose vertices are in a scattered order; the results must not show the
// renumbering.
#include "ibmfair/flow/passes/local_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "ibmfair/flow/fixed_vertices.h"
#include "ibmfair/flow/time_scale.h"
#include "ibmfair/flow/willmore_flow.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/shapes/grids.h"
#include "ibmfair/shapes/noise.h"
#include "support/renumbered.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

TriangleMesh noisy_torus(Index rows, Index columns) {
  GridSize size;
  size.rows = rows;
  size.columns = columns;
  TriangleMesh mesh = make_torus(2.5, size);
  add_noise(mesh.X, 0.002, 1);
  return mesh;
}

/// The mesh without some of its triangles, and with one defect of each kind that leaves it
/// orientable.
TriangleMesh wounded(TriangleMesh mesh) {
  const Eigen::Index vertices = mesh.X.rows(), triangles = mesh.F.rows() - 40;
  mesh.X.conservativeResize(vertices + 2, 3);  // two more vertices, one of them in no triangle
  const Eigen::RowVector3i x = mesh.F.row(0);
  mesh.X.row(vertices) = 0.5 * (mesh.X.row(x[0]) + mesh.X.row(x[1]));
  mesh.X.row(vertices + 1) << 5, 5, 5;
  mesh.F.conservativeResize(triangles + 3, 3);
  mesh.F.row(triangles) << x[0], static_cast<Index>(vertices), x[1];  // a triangle of no area
  mesh.F.row(triangles + 1) = mesh.F.row(7);
  mesh.F.row(triangles + 2) << mesh.F(90, 0), mesh.F(90, 1), mesh.F(90, 0);
  return mesh;
}

struct Shuffled {
  TriangleMesh mesh;
  std::vector<Index> number;  // the new number of each vertex
};

Shuffled shuffled(const TriangleMesh& mesh) {
  const std::vector<Index> number = permutation(mesh.X.rows(), 3);
  return {renumbered(mesh, number), number};
}

State state_of(const TriangleMesh& mesh) {
  return State(mesh_from_triangles(mesh.X, mesh.F));
}

/// The rows as a sorted list of triples. Each triple is rotated so that its smallest number comes
/// first.
std::vector<std::array<Index, 3>> sorted_triangles(const Triangles& F) {
  std::vector<std::array<Index, 3>> triangles;
  for (const auto row : F.rowwise()) {
    std::array<Index, 3> x{row[0], row[1], row[2]};
    std::rotate(x.begin(), std::min_element(x.begin(), x.end()), x.end());
    triangles.push_back(x);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

double mean_distance_in_memory(const Topology& topology) {
  double sum = 0;
  for (const auto e : topology.E.rowwise()) {
    sum += e[1] - e[0];
  }
  return sum / static_cast<double>(topology.E.rows());
}

TEST(LocalMesh, IsTheSameMesh) {
  const State state = state_of(shuffled(wounded(noisy_torus(80, 90))).mesh);
  const Topology& topology = state.topology;
  std::vector<std::uint8_t> fixed = fixed_vertices(topology, BoundaryCondition::fixed);
  FlowOptions options;
  options.cutoff_factor = state.X.col(0).array() + 10;
  options.spontaneous_curvature = state.X.col(1);
  options.material_directions = material_directions(state.X, topology, Vec3(1, 2, 3), 4);
  const LocalMesh local = local_mesh(state.X, topology, fixed, options);

  const std::vector<Index>& vertex = local.vertex;
  std::vector<Index> all = vertex;
  std::sort(all.begin(), all.end());
  std::vector<Index> numbers(static_cast<std::size_t>(topology.vertex_count));
  std::iota(numbers.begin(), numbers.end(), 0);
  EXPECT_EQ(all, numbers);
  for (Index i = 0; i < topology.vertex_count; ++i) {
    const Index v = vertex[i];
    ASSERT_EQ(local.X.row(i), state.X.row(v));
    ASSERT_EQ(local.fixed[i], fixed[v]);
    ASSERT_EQ(local.topology.kind[i], topology.kind[v]);
    ASSERT_EQ(local.topology.defective[i], topology.defective[v]);
    ASSERT_EQ(local.options.cutoff_factor[i], options.cutoff_factor[v]);
    ASSERT_EQ(local.options.spontaneous_curvature[i], options.spontaneous_curvature[v]);
  }
  Triangles F = local.topology.F;
  for (Index& corner : F.reshaped()) {
    corner = vertex[corner];
  }
  EXPECT_EQ(sorted_triangles(F), sorted_triangles(topology.F));
  EXPECT_EQ(local.topology.H.rows(), topology.H.rows());
  EXPECT_EQ(local.topology.component_count, topology.component_count);
  EXPECT_EQ(local.topology.boundary_loops.size(), topology.boundary_loops.size());
  EXPECT_EQ(local.topology.defects.zero_area.size(), topology.defects.zero_area.size());
  EXPECT_EQ(local.topology.defects.duplicate.size(), 2U);
  EXPECT_EQ(local.topology.defects.count(), topology.defects.count());
  const auto directions = material_directions(local.X, local.topology, Vec3(1, 2, 3), 4);
  for (std::size_t t = 0; t < directions.size(); ++t) {
    if (local.topology.usable[t]) {
      ASSERT_EQ(directions[t].rate, local.options.material_directions[t].rate);
    }
  }
}

TEST(LocalMesh, BringsNeighboursTogether) {
  const State state = state_of(shuffled(noisy_torus(80, 90)).mesh);
  const std::vector<std::uint8_t> fixed(state.X.rows(), 0);
  const LocalMesh local = local_mesh(state.X, state.topology, fixed, {});
  EXPECT_LT(mean_distance_in_memory(local.topology), 0.1 * mean_distance_in_memory(state.topology));
}

TEST(LocalMesh, IsForLargeScatteredMeshes) {
  const TriangleMesh large = noisy_torus(160, 200);
  EXPECT_FALSE(is_scattered(state_of(large).topology)) << "its own order";
  EXPECT_TRUE(is_scattered(state_of(shuffled(large).mesh).topology));
  EXPECT_FALSE(is_scattered(state_of(shuffled(noisy_torus(80, 90)).mesh).topology)) << "small";
}

/// A grid whose last column is joined to its first column upside down.
TEST(LocalMesh, IsNotForMeshesWithoutAnOrientation) {
  constexpr Index columns = 400, rows = 81;
  TriangleMesh strip{Points(columns * rows, 3), Triangles(2 * columns * (rows - 1), 3)};
  const auto number = [&](Index i, Index j) { return i < columns ? i * rows + j : rows - 1 - j; };
  Index t = 0;
  for (Index i = 0; i < columns; ++i) {
    const double u = 2 * M_PI * i / columns;
    for (Index j = 0; j < rows; ++j) {
      const double across = static_cast<double>(2 * j - (rows - 1)) / rows;
      const double r = 3 + across * std::cos(u / 2);
      strip.X.row(number(i, j)) << r * std::cos(u), r * std::sin(u), across * std::sin(u / 2);
    }
    for (Index j = 0; j + 1 < rows; ++j) {
      const Index a = number(i, j), b = number(i + 1, j), c = number(i + 1, j + 1);
      strip.F.row(t++) << a, b, c;
      strip.F.row(t++) << a, c, number(i, j + 1);
    }
  }
  const State state = state_of(shuffled(strip).mesh);
  EXPECT_FALSE(state.topology.orientable);
  EXPECT_FALSE(is_scattered(state.topology));
}

/// Values that belong to vertices and triangles are renumbered with them.
TEST(LocalMesh, FlowsLikeTheMeshInOrder) {
  const TriangleMesh mesh = wounded(noisy_torus(160, 200));
  const Shuffled other = shuffled(mesh);
  for (const char* laplacian : {"crouzeix-raviart", "lagrange"}) {
    const auto flown = [&](const TriangleMesh& start) {
      State state = state_of(start);
      FlowOptions options;
      options.laplacian = laplacian;
      options.steps = 2;
      options.cutoff_factor = (3 + state.X.col(0).array()) / 3;
      if (options.laplacian == "lagrange") {
        options.spontaneous_curvature = state.X.col(1);
      }
      const double length = 4 * mean_edge_length(state.X, state.topology.E);
      options.total_time =
          time_in_flow_units(time_for_cutoff(length), state.X, state.topology, options);
      auto fixed = fixed_vertices(state.topology, BoundaryCondition::fixed);
      for (Eigen::Index v = 0; v < state.X.rows(); ++v) {
        fixed[v] |= state.X(v, 2) > 0.3 ? 1 : 0;
      }
      const FlowReport report = willmore_flow(state.X, state.topology, fixed, options);
      EXPECT_EQ(report.status, FlowStatus::completed);
      return state.X;
    };
    const Points one = flown(mesh), two = flown(other.mesh);
    const double largest = (two(other.number, Eigen::all) - one).rowwise().norm().maxCoeff();
    EXPECT_LT(largest, 1e-7) << laplacian;  // sums in float32 are in another order
    EXPECT_GT((one - mesh.X).norm(), 1e-3) << "nothing moved";
  }
}

}  // namespace
}  // namespace ibmfair::test
