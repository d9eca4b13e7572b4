// Where --denoise cannot tell noise from the shape, the shape stays. Through the real program.
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "ibmfair/mesh/geometry.h"
#include "ibmfair/mesh/mesh.h"
#include "ibmfair/mesh/topology.h"
#include "ibmfair/shapes/noise.h"
#include "ibmfair/shapes/subdivide.h"
#include "support/files.h"
#include "support/run_program.h"
#include "support/smooth_runs.h"

namespace ibmfair::test {
namespace {

using nlohmann::json;

class MildDenoise : public SmoothRuns {
 protected:
  std::string write(const TriangleMesh& mesh, const std::string& name) const {
    std::string path = files_ / name;
    std::ofstream file(path);
    for (const auto& x : mesh.X.rowwise()) {
      file << fmt::format("v {} {} {}\n", x[0], x[1], x[2]);
    }
    for (const auto& f : mesh.F.rowwise()) {
      file << fmt::format("f {} {} {}\n", f[0] + 1, f[1] + 1, f[2] + 1);
    }
    return path;
  }

  TriangleMesh made(const std::string& shape, const Words& options) {
    const MeshFile file = read_mesh(noisy(shape, options));
    return {file.mesh().X, triangulate(file.mesh()).F};
  }

  /// The mean angle (degrees) between the face normals of two meshes.
  static double degrees_between(const std::string& a, const std::string& b) {
    const RunResult run = run_program({"compare", a, b, "--json"});
    return json::parse(run.out)["face_normal_degrees"]["mean"].get<double>();
  }

  void expect_unchanged(const std::string& input) {
    const Smoothed out = smooth(input, {"--denoise"});
    EXPECT_EQ(out.report["cutoff_choice"]["kind"], "none") << out.err;
    EXPECT_TRUE(contains(out.err, "no noise was found")) << out.err;
    EXPECT_TRUE(out.X == read_mesh(input).mesh().X);
  }
};

TEST_F(MildDenoise, SaysWhenThereAreTooFewVerticesToBeSure) {
  for (const auto& [levels, is_sure] : {std::pair{"2", false}, {"3", false}, {"4", true}}) {
    const Smoothed out =
        smooth(noisy("icosahedron", {"--subdivide", levels, "--noise", "0.2"}), {"--denoise"});
    EXPECT_EQ(contains(out.err, "can hardly be told from the shape"), !is_sure) << levels;
  }
}

double mean_edge(const TriangleMesh& mesh) {
  return mean_edge_length(mesh.X, build_topology(mesh.X, mesh.F).E);
}

TEST_F(MildDenoise, CoarsePartsWithNextToNoNoiseKeepTheirEdges) {
  for (const std::string noise : {"0", "0.0001", "0.001", "0.01", "0.03"}) {
    SCOPED_TRACE(noise);
    expect_unchanged(noisy("cube", {"--subdivide", "2", "--noise", noise}));
    expect_unchanged(noisy("cube", {"--subdivide", "3", "--noise", noise}));
  }
}

/// Most of their vertices are near edges, whose shape cut-offs take for noise.
TEST_F(MildDenoise, CoarsePartsWithNoiseAreFreedOfItAndKeepTheirEdges) {
  for (const std::string levels : {"3", "4"}) {
    const std::string truth = write(made("cube", {"--subdivide", levels}), "truth.obj");
    for (const std::string noise : {"0.05", "0.1"}) {
      SCOPED_TRACE(levels + ", " + noise);
      const std::string input = noisy("cube", {"--subdivide", levels, "--noise", noise});
      const Smoothed out = smooth(input, {"--denoise"});
      ASSERT_EQ(out.exit_code, 0) << out.err;
      EXPECT_LT(degrees_between(files_ / "out.ply", truth), 0.5 * degrees_between(input, truth));
    }
  }
}

TEST_F(MildDenoise, ConesWithRoundedCoordinatesKeepTheirFacets) {
  for (const int around : {16, 64}) {
    SCOPED_TRACE(around);
    TriangleMesh cone{Points(2 * around + 2, 3), Triangles(4 * around, 3)};
    const auto rounded = [](double x) { return std::round(2500 * x) / 100; };
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * std::numbers::pi * i / around;
      for (const auto& [ring, radius] : {std::pair{0, 1.0}, {1, 0.5}}) {
        cone.X.row(ring * around + i) << rounded(radius * std::cos(angle)),
            rounded(radius * std::sin(angle)), 25 * ring;
      }
      const int next = (i + 1) % around, top = around + i, next_top = around + next;
      cone.F.row(4 * i) << i, next, next_top;
      cone.F.row(4 * i + 1) << i, next_top, top;
      cone.F.row(4 * i + 2) << next, i, 2 * around;
      cone.F.row(4 * i + 3) << top, next_top, 2 * around + 1;
    }
    cone.X.row(2 * around) << 0, 0, 0;
    cone.X.row(2 * around + 1) << 0, 0, 50;
    expect_unchanged(write(cone, "cone.obj"));
  }
}

TEST_F(MildDenoise, EvenDetailStays) {
  TriangleMesh ball = made("icosphere", {"--subdivide", "4"});
  for (const double height : {0.02, 0.04}) {  // waves of seven edges, all over
    SCOPED_TRACE(height);
    TriangleMesh bumpy = ball;
    for (Eigen::Index v = 0; v < bumpy.X.rows(); ++v) {
      const Eigen::Array3d x = 16 * ball.X.row(v).transpose().array();
      const double waves = std::sin(x[0] + std::cos(x[2])) + std::sin(x[1] - std::cos(x[0])) +
                           std::sin(x[2] + std::cos(x[1]));
      bumpy.X.row(v) *= 1 + height / 3 * waves;
    }
    expect_unchanged(write(bumpy, "bumpy.obj"));
  }
}

TEST_F(MildDenoise, ThreadsStay) {
  const TriangleMesh rod = made("cylinder", {"--rows", "80", "--columns", "100"});
  for (const double rows : {8.0, 10.0}) {
    SCOPED_TRACE(rows);
    const double pitch = 2 * rows / 79;
    TriangleMesh thread = rod;
    for (auto x : thread.X.rowwise()) {
      const double turns = x[2] / pitch - std::atan2(x[1], x[0]) / (2 * std::numbers::pi);
      x.head<2>() *= 1 + 0.35 * pitch * std::sin(2 * std::numbers::pi * turns);
    }
    expect_unchanged(write(thread, "thread.obj"));
  }
}

/// The facets of a coarse ball that was subdivided are even and as long as four edges.
TEST_F(MildDenoise, FacetsAreNotTakenForCorrelatedNoise) {
  const TriangleMesh facets =
      split_all_triangles(split_all_triangles(made("icosphere", {"--subdivide", "3"})));
  const std::string truth = write(facets, "truth.obj");
  for (const double noise : {0.02, 0.03, 0.05}) {
    SCOPED_TRACE(noise);
    TriangleMesh rough = facets;
    add_noise(rough.X, noise * mean_edge(facets), 1);
    const std::string input = write(rough, "rough.obj");
    const Smoothed out = smooth(input, {"--denoise"});
    EXPECT_NE(out.report["cutoff_choice"]["kind"], "correlated") << out.err;
    EXPECT_LE(degrees_between(files_ / "out.ply", truth), 1.001 * degrees_between(input, truth));
  }
}

/// The rows and columns of a grid are on levels as well.
TEST_F(MildDenoise, StudsAndFlutesOnAGridStay) {
  TriangleMesh studs = made("plane", {"--straight", "--rows", "100", "--columns", "100"});
  for (Eigen::Index v = 0; v < studs.X.rows(); ++v) {
    const Eigen::Index row = v / 100, column = v % 100;
    studs.X(v, 2) = row % 6 < 3 && column % 6 < 3 ? 0.03 : 0;
  }
  expect_unchanged(write(studs, "studs.obj"));
  TriangleMesh flutes = made("cylinder", {"--straight", "--rows", "40", "--columns", "96"});
  for (auto x : flutes.X.rowwise()) {
    x.head<2>() *= 1 + 0.04 * std::sin(24 * std::atan2(x[1], x[0]));
  }
  expect_unchanged(write(flutes, "flutes.obj"));
}

/// A depth camera's image: noise of a third of a step along the rays, then whole steps.
TEST_F(MildDenoise, RoundedDepthIsSmoothed) {
  const TriangleMesh plane = made("plane", {"--straight", "--rows", "80", "--columns", "80"});
  TriangleMesh scene = plane, seen = plane;
  Points noise = Points::Zero(plane.X.rows(), 3);
  add_noise(noise, 1, 3);
  for (const double edges : {0.3, 0.6}) {
    SCOPED_TRACE(edges);
    const double step = edges * 2 * mean_edge(plane);
    for (Eigen::Index v = 0; v < plane.X.rows(); ++v) {
      const Vec3 ray(plane.X(v, 0), plane.X(v, 1), 1);
      const double depth = 2 + 0.1 * std::sin(5 * ray[0]) + 0.08 * std::cos(4 * ray[1]);
      const double measured = step * std::round(depth / step + 0.3 * noise(v, 0));
      scene.X.row(v) = depth * ray.transpose();
      seen.X.row(v) = measured * ray.transpose();
    }
    const std::string truth = write(scene, "truth.obj"), input = write(seen, "seen.obj");
    const Smoothed out = smooth(input, {"--denoise"});
    ASSERT_EQ(out.exit_code, 0) << out.err;
    const double before = degrees_between(input, truth);
    EXPECT_GT(before, 5);
    EXPECT_LT(degrees_between(files_ / "out.ply", truth), 0.15 * before);
  }
}

TEST_F(MildDenoise, ASmallPartBesideALargeOneKeepsItsShape) {
  const Words fine{"--subdivide", "4"};
  const TriangleMesh clean = made("cube", fine);
  const TriangleMesh rough = made("cube", fine + Words{"--noise", "0.2"});
  const auto pair_of = [](const TriangleMesh& cube, double ratio) {
    const Eigen::Index n = cube.X.rows(), m = cube.F.rows();
    TriangleMesh both{Points(2 * n, 3), Triangles(2 * m, 3)};
    both.X << cube.X, (ratio * cube.X).rowwise() + Eigen::RowVector3d(3, 0, 0);
    both.F << cube.F, cube.F.array() + static_cast<Index>(n);
    return both;
  };
  for (const double ratio : {0.5, 0.1, 0.03}) {
    SCOPED_TRACE(ratio);
    const std::string truth = write(pair_of(clean, ratio), "truth.obj");
    const Smoothed out = smooth(write(pair_of(rough, ratio), "both.obj"), {"--denoise"});
    EXPECT_TRUE(contains(out.err, "shorter edges than others")) << out.err;
    EXPECT_LT(degrees_between(files_ / "out.ply", truth), 1.5);
  }
}

TEST_F(MildDenoise, SeamsAndSoupsAreReported) {
  const TriangleMesh ball = made("icosphere", {"--subdivide", "3", "--noise", "0.2"});
  TriangleMesh soup{Points(3 * ball.F.rows(), 3), Triangles(ball.F.rows(), 3)};
  TriangleMesh seam{Points(2 * ball.X.rows(), 3), ball.F};
  seam.X << ball.X, ball.X;
  for (Index t = 0; t < ball.F.rows(); ++t) {
    double side = 0;
    for (int i = 0; i < 3; ++i) {
      soup.X.row(3 * t + i) = ball.X.row(ball.F(t, i));
      soup.F(t, i) = 3 * t + i;
      side += ball.X(ball.F(t, i), 0);
    }
    if (side > 0) {
      seam.F.row(t).array() += static_cast<Index>(ball.X.rows());
    }
  }
  for (const TriangleMesh& mesh : {soup, seam}) {
    const Smoothed out = smooth(write(mesh, "apart.obj"), {"--denoise", "--verbose"});
    EXPECT_EQ(out.exit_code, 0);
    EXPECT_TRUE(contains(out.err, "--weld merges such vertices")) << out.err;
    EXPECT_FALSE(contains(out.err, "nan")) << out.err;
    EXPECT_FALSE(contains(out.report.dump(), "NaN"));
  }
}

}  // namespace
}  // namespace ibmfair::test
