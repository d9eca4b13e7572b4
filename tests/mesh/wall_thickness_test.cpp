// The thickness of walls: exact on plates in any place, and none where there is no wall.
#include "ibmfair/mesh/wall_thickness.h"

#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "ibmfair/shapes/shapes.h"
#include "support/meshes.h"
#include "support/solids.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

std::vector<Wall> all_walls(const State& state, double thickest) {
  std::vector<Index> triangles(static_cast<std::size_t>(state.topology.F.rows()));
  std::iota(triangles.begin(), triangles.end(), 0);
  return find_walls(state.X, state.topology, triangles, thickest);
}

/// Whether triangle t of a flat plate is a part of one of its two sheets, away from the rim.
bool is_inner(const State& plate, Index t) {
  for (const Index v : plate.topology.F.row(t)) {
    const auto x = plate.X.row(v);
    if (x[0] < 1 || x[0] > 9 || x[1] < 1 || x[1] > 7) {
      return false;
    }
  }
  return true;
}

TEST(Walls, OfAPlateHaveItsThicknessWhateverItsPlaceAndOrientation) {
  for (const double thickness : {0.01, 0.3, 1.0, 1.9}) {
    const Mesh flat = plate(10, 8, thickness);
    const State at_origin(flat);
    Mesh inside_out = flat;
    inside_out.X.col(0) *= -1;
    for (const Mesh& mesh : {flat, moved(flat, 1e-8, Vec3::Zero()), moved(flat, 1e8, Vec3::Zero()),
                             moved(flat, 1, Vec3(1e3, -1e3, 1e3)), inside_out}) {
      const State state(mesh);
      const double size = mean_edge_length(state.X, state.topology.E) /
                          mean_edge_length(at_origin.X, at_origin.topology.E);
      const std::vector<Wall> walls = all_walls(state, 2 * size);
      for (Index t = 0; t < state.topology.F.rows(); ++t) {
        if (is_inner(at_origin, t)) {
          EXPECT_NEAR(walls[t].thickness / size, thickness, 1e-9 * (1 + thickness));
          EXPECT_NEAR(walls[t].weights.sum(), 1, 1e-9);
        }
      }
    }
  }
}

TEST(Walls, FollowTheSheetsThroughEachOther) {
  const State state(plate(10, 8, 0.5));
  const std::vector<Wall> walls = all_walls(state, 2);
  const std::vector<int> outward = outward_signs(state.X, state.topology);
  for (const double thickness : {1.0, 0.25, -0.5}) {
    Points Y = state.X;
    Y.col(2) *= thickness / 0.5;
    const Points vectors = vertex_area_vectors(Y, state.topology);
    for (Index t = 0; t < state.topology.F.rows(); ++t) {
      if (is_inner(state, t) && thickness > 0) {
        EXPECT_NEAR(thickness_at(Y, vectors, state.topology, t, walls[t], outward[0]), thickness,
                    1e-9);
      }
    }
  }
  Points crossed = state.X;  // the lower sheet is moved through the upper one
  for (Index v = 0; v < crossed.rows(); ++v) {
    crossed(v, 2) += crossed(v, 2) == 0 ? 1 : 0;
  }
  const Points vectors = vertex_area_vectors(crossed, state.topology);
  for (Index t = 0; t < state.topology.F.rows(); ++t) {
    if (is_inner(state, t)) {
      EXPECT_NEAR(thickness_at(crossed, vectors, state.topology, t, walls[t], outward[0]), -0.5,
                  1e-9);
    }
  }
}

TEST(Walls, AreNotFoundInSolidsOpenMeshesAndOneSidedSurfaces) {
  std::vector<Mesh> meshes{make_shape("icosphere", {.subdivide = 3}), flat_sheet(10, 10)};
  for (const NamedMesh& mesh : open_meshes()) {
    if (mesh.name.find("sphere") == std::string::npos) {
      meshes.push_back(mesh.mesh);
    }
  }
  for (const NamedMesh& mesh : nonorientable_meshes()) {
    meshes.push_back(mesh.mesh);
  }
  for (const Mesh& mesh : meshes) {
    const State state(mesh);
    for (const Wall& wall : all_walls(state, 3 * mean_edge_length(state.X, state.topology.E))) {
      EXPECT_FALSE(wall.exists());
      EXPECT_TRUE(std::isinf(wall.thickness));
    }
  }
}

TEST(Walls, OfNoisySheetsAreFoundAllOver) {
  State state(plate(20, 20, 0.5));
  state.X = shaken(state, 0.2);
  const std::vector<Wall> walls = all_walls(state, 2);
  const auto found = std::ranges::count_if(walls, [](const Wall& wall) { return wall.exists(); });
  EXPECT_GT(found, 0.9 * static_cast<double>(walls.size()));
}

}  // namespace
}  // namespace ibmfair::test
