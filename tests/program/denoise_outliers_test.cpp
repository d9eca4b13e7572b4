// Outliers, vertices far off the surface: --denoise moves them first, through the real
// program, and a mesh without other noise is written as it was read but for them.
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "ibmfair/base/random_numbers.h"
#include "ibmfair/io/mesh_file.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/shapes/noise.h"
#include "ibmfair/shapes/shapes.h"
#include "support/files.h"
#include "support/mesh_io.h"
#include "support/smooth_runs.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

class DenoiseOutliers : public SmoothRuns {
 protected:
  /// Writes the mesh with noise (mean edge lengths), and with one vertex in `every` moved by `far`
  /// mean edge lengths, at rims along the normal. Returns the numbers of these vertices.
  std::vector<Index> damage(const Mesh& mesh, double noise, int every, double far) {
    Mesh damaged = in_triangles(mesh);
    write_mesh(damaged, truth_, {.overwrite = true});
    const State state(damaged);
    edge_ = mean_edge_length(state.X, state.topology.E);
    add_noise(damaged.X, noise * edge_, 1);
    RandomNumbers random(2);
    std::vector<Index> moved;
    for (Index v = every / 2; v < damaged.X.rows(); v += every) {
      Vec3 way(random.normal(), random.normal(), random.normal());
      if (state.topology.kind[v] == VertexKind::boundary) {
        way = double_area_vector_at(v, state.X, state.topology);
      }
      damaged.X.row(v) += far * edge_ * way.normalized();
      moved.push_back(v);
    }
    write_mesh(damaged, input_, {.overwrite = true});
    return moved;
  }

  /// The mean angle between the normals of the triangles at X and those of the truth, degrees.
  double degrees_off() const {
    const Words compare{"compare", files_ / "out.ply", truth_, "--json"};
    return nlohmann::json::parse(run_program(compare).out)["face_normal_degrees"]["mean"];
  }

  const std::string input_ = files_ / "damaged.ply", truth_ = files_ / "truth.ply";
  double edge_ = 0;
};

std::vector<Mesh> shapes() {
  return {make_shape("torus", {.rows = 24, .columns = 60}), make_shape("cube", {.subdivide = 4}),
          make_shape("catenoid", {}), read_mesh(project_file("data/bunny.obj")).mesh()};
}

TEST_F(DenoiseOutliers, AreAllThatMovesWithoutOtherNoise) {
  for (const Mesh& mesh : shapes()) {
    for (const double far : {3.0, 5.0, 20.0}) {
      SCOPED_TRACE(fmt::format("{} vertices, {}", mesh.X.rows(), far));
      const std::vector<Index> moved = damage(mesh, 0, 97, far);
      const Smoothed clean = smooth(input_, {"--denoise"});
      ASSERT_EQ(clean.exit_code, 0) << clean.err;
      EXPECT_EQ(clean.report.value("outliers", std::vector<Index>()), moved);
      EXPECT_EQ(clean.report["cutoff_choice"]["kind"], "none") << clean.err;
      EXPECT_TRUE(contains(clean.err, "far off the surface of their neighbours")) << clean.err;
      EXPECT_TRUE(contains(clean.err, "all other vertices are written as read")) << clean.err;
      const Points before = read_mesh(input_).mesh().X;
      for (Index v = 0; v < before.rows(); ++v) {
        if (!std::ranges::binary_search(moved, v)) {
          ASSERT_EQ(clean.X.row(v), before.row(v)) << v;
        }
      }
      EXPECT_LT(degrees_off(), 0.5);
    }
  }
}

/// Without the outliers' detour, normals end as near to the truth as without outliers.
TEST_F(DenoiseOutliers, DoNotDisturbTheChoicesForOtherNoise) {
  for (const Mesh& mesh : {make_shape("torus", {.rows = 24, .columns = 60}),
                           make_shape("icosahedron", {.subdivide = 4})}) {
    damage(mesh, 0.1, 1 << 20, 0);
    smooth(input_, {"--denoise"});
    const double without = degrees_off();
    const std::vector<Index> moved = damage(mesh, 0.1, 97, 6);
    const Smoothed denoised = smooth(input_, {"--denoise"});
    ASSERT_EQ(denoised.exit_code, 0) << denoised.err;
    EXPECT_EQ(denoised.report.value("outliers", std::vector<Index>()), moved);
    EXPECT_EQ(denoised.report["cutoff_choice"]["kind"], "independent");
    EXPECT_NEAR(denoised.report["cutoff_choice"]["noise"], 0.1 * edge_, 0.02 * edge_);
    EXPECT_LT(degrees_off(), without + 0.3);
  }
}

TEST_F(DenoiseOutliers, StayWhereAnOptionAsksForIt) {
  const std::vector<Index> moved =
      damage(make_shape("torus", {.rows = 24, .columns = 60}), 0, 97, 5);
  write_bytes(files_ / "fixed.txt", fmt::format("{}\n", moved.front()));
  const Smoothed all_but_one = smooth(input_, {"--denoise", "--fix", files_ / "fixed.txt"});
  EXPECT_EQ(all_but_one.report["outliers"].size(), moved.size() - 1) << all_but_one.err;
  EXPECT_EQ(all_but_one.X.row(moved.front()), read_mesh(input_).mesh().X.row(moved.front()));
  const Smoothed bounded = smooth(input_, {"--denoise", "--max-move", "0.1e"});
  EXPECT_FALSE(bounded.report.contains("outliers"));
  EXPECT_LE(bounded.report["largest_move"].get<double>(), 0.1 * edge_ * 1.001);
  const Smoothed plain = smooth(input_, {"--cutoff", "auto"});
  EXPECT_FALSE(plain.report.contains("outliers"));
}

}  // namespace
}  // namespace ibmfair::test
