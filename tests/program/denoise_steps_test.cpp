// Errors that come in steps, as people's files have them: the surface of voxels, and heights that
// were rounded to whole numbers. --denoise leaves what is right.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "ibmfair/base/angle.h"
#include "ibmfair/io/mesh_file.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/mesh/topology.h"
#include "support/files.h"
#include "support/run_program.h"
#include "support/solids.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {
namespace {

using nlohmann::json;

class DenoisedSteps : public testing::Test {
 protected:
  json denoise(const std::string& input) {
    const RunResult run =
        run_program({"smooth", input, files_ / "out.ply", "--denoise", "--json", "--overwrite"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return json::parse(run.out, nullptr, false);
  }

  TemporaryDirectory files_;
};

TEST_F(DenoisedSteps, OfVoxelsLeaveTheirBall) {
  const json report = denoise(project_file("tests/flow/reported/ball8_1.off"));
  EXPECT_EQ(report["cutoff_choice"]["kind"], "steps");
  EXPECT_FALSE(report["cutoff_choice"].contains("distance_expected"));
  const double before = report["before"]["volume"], after = report["after"]["volume"];
  EXPECT_NEAR(after, before, 0.01 * before);
  const RunResult compared =
      run_program({"compare", files_ / "out.ply", "--sphere", "fit", "--json"});
  const json normals = json::parse(compared.out)["exact_surface"]["triangle_normal_degrees"];
  EXPECT_LT(normals["rms"].get<double>(), 1.5);  // 23.4 before
}

/// Heights over 120 x 120 points.
double height(int x, int y) {
  const double bump = std::exp(-(std::pow(x - 70, 2) + std::pow(y - 50, 2)) / 500);
  return 8 * std::sin(x / 28.0) * std::cos(y / 33.0) + 4 * bump;
}

TEST_F(DenoisedSteps, OfRoundedHeightsLeaveTheHeightsAndTheBorder) {
  constexpr int n = 120, border = 5;
  std::string text;
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      text += "v " + std::to_string(x) + " " + std::to_string(y) + " " +
              std::to_string(std::lround(height(x, y))) + "\n";
    }
  }
  for (int y = 0; y + 1 < n; ++y) {
    for (int x = 0; x + 1 < n; ++x) {
      const auto at = [&](int i, int j) { return std::to_string((y + j) * n + x + i + 1) + " "; };
      text +=
          "f " + at(0, 0) + at(1, 0) + at(1, 1) + "\nf " + at(0, 0) + at(1, 1) + at(0, 1) + "\n";
    }
  }
  write_bytes(files_ / "heights.obj", text);
  denoise(files_ / "heights.obj");
  const Points before = read_mesh(files_ / "heights.obj").mesh().X;
  const Points after = read_mesh(files_ / "out.ply").mesh().X;
  double squares = 0, count = 0;
  for (Eigen::Index v = 0; v < after.rows(); ++v) {
    const int x = static_cast<int>(v) % n, y = static_cast<int>(v) / n;
    const int inside = std::min({x, y, n - 1 - x, n - 1 - y});
    if (inside == 0) {
      EXPECT_EQ(after.row(v), before.row(v)) << x << " " << y;
    } else if (inside >= border) {
      squares += std::pow(after(v, 2) - height(x, y), 2);
      ++count;
    }
  }
  EXPECT_LT(std::sqrt(squares / count), 0.055);  // 0.29 before
}

/// A rotation that turns no axis into another one.
Eigen::Matrix3d tilt() {
  return Eigen::Quaterniond(0.8, 0.2, 0.4, 0.4).normalized().toRotationMatrix();
}

/// The distance of x to the surface of a tilted box with these half sides, negative inside as the
/// distance to the nearest face.
double distance_to_box(const Vec3& x, const Vec3& half_sides) {
  const Vec3 beyond = (tilt() * x).cwiseAbs() - half_sides;
  return std::min(beyond.maxCoeff(), 0.0) + beyond.cwiseMax(0).norm();
}

double rms_distance_to_box(const Points& X, const Vec3& half_sides) {
  double squares = 0;
  for (const Vec3 x : X.rowwise()) {
    squares += std::pow(distance_to_box(x, half_sides), 2);
  }
  return std::sqrt(squares / static_cast<double>(X.rows()));
}

TEST_F(DenoisedSteps, OfVoxelsLeaveTheEdgesOfBoxes) {
  constexpr int n = 34;
  std::vector<double> at(n + 1);
  for (int i = 0; i <= n; ++i) {
    at[i] = i - n / 2;
  }
  for (const Vec3& half_sides : {Vec3(11, 8, 5), Vec3(9, 9, 9), Vec3(12, 12, 3)}) {
    const auto is_inside = [&](Index i, Index j, Index k) {
      return distance_to_box(Vec3(at[i] + 0.5, at[j] + 0.5, at[k] + 0.5), half_sides) < 0;
    };
    write_mesh(solid_of_cells(at, at, at, is_inside), files_ / "box.ply", {.overwrite = true});
    const json report = denoise(files_ / "box.ply");
    EXPECT_EQ(report["cutoff_choice"]["kind"], "steps");
    EXPECT_TRUE(report["cutoff_choice"].contains("keep_sharp"));
    const Points before = read_mesh(files_ / "box.ply").mesh().X;
    const Points after = read_mesh(files_ / "out.ply").mesh().X;
    EXPECT_LT(rms_distance_to_box(after, half_sides), 0.7 * rms_distance_to_box(before, half_sides))
        << half_sides.transpose();
  }
}

TEST_F(DenoisedSteps, OfRoundedCoordinatesLeaveTheEdgesOfACube) {
  ASSERT_EQ(run_program({"make", "cube", files_ / "cube.ply", "--subdivide", "4"}).exit_code, 0);
  Mesh cube = read_mesh(files_ / "cube.ply").mesh();
  cube.X = cube.X * tilt();
  const Triangles F = triangulate(cube).F;
  const Points exact = triangle_normals(cube.X, F);
  const double mean_edge = mean_edge_length(cube.X, build_topology(cube.X, F).E);
  for (const double edges : {0.35, 0.5}) {
    const double step = edges * mean_edge;
    Mesh rounded = cube;
    rounded.X = step * (cube.X / step).array().round().matrix();
    write_mesh(rounded, files_ / "rounded.ply", {.overwrite = true});
    const json report = denoise(files_ / "rounded.ply");
    EXPECT_EQ(report["cutoff_choice"]["kind"], "steps");
    const auto mean_angle = [&](const Points& X) {
      const Points normals = triangle_normals(X, F);
      const Eigen::VectorXd cosines = normals.cwiseProduct(exact).rowwise().sum();
      return degrees(cosines.cwiseMin(1).array().acos().mean());
    };
    EXPECT_LT(mean_angle(read_mesh(files_ / "out.ply").mesh().X), 0.4 * mean_angle(rounded.X));
  }
}

}  // namespace
}  // namespace ibmfair::test
