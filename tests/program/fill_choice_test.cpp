// `ibmfair fill` chooses the method for a patch by the mesh around the hole.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "ibmfair/io/mesh_file.h"
#include "ibmfair/shapes/noise.h"
#include "ibmfair/shapes/shapes.h"
#include "support/files.h"
#include "support/holed_meshes.h"
#include "support/run_program.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {
namespace {

using nlohmann::json;

constexpr double edge_length = 0.07;  // of sphere(4), about

class FillChoice : public testing::Test {
 protected:
  struct Filled {
    Mesh after;
    json hole;  ///< the report of the only hole
  };

  Filled fill(const Mesh& mesh, std::vector<std::string> options = {}) {
    const std::string in = directory_ / fmt::format("in{}.off", inputs_++),
                      out = directory_ / "out.off";
    write_mesh(mesh, in);
    std::vector<std::string> arguments{"fill", in, out, "--json", "--overwrite"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const RunResult run = run_program(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const json told = json::parse(run.out, nullptr, false);
    return {read_mesh(out).mesh(), told["holes"][0]};
  }

  TemporaryDirectory directory_;
  int inputs_ = 0;
};

Mesh noisy_sphere(int level, double degrees, double noise, std::uint64_t seed) {
  Mesh mesh = without_cap(sphere(level), degrees);
  add_noise(mesh.X, noise * edge_length, seed);
  return mesh;
}

/// Root mean square distance of the new vertices from the unit sphere.
double sphere_error(const Mesh& before, const Mesh& after) {
  const Points X = after.X.bottomRows(after.X.rows() - before.X.rows());
  return std::sqrt((X.rowwise().norm().array() - 1).square().mean());
}

TEST_F(FillChoice, SmoothSurroundingsGetTheMostExactLaplacian) {
  for (const double degrees : {20.0, 45.0, 90.0}) {
    SCOPED_TRACE(degrees);
    const Mesh mesh = without_cap(sphere(4), degrees);
    const Filled chosen = fill(mesh);
    EXPECT_EQ(chosen.hole["surroundings"]["kind"], "smooth");
    EXPECT_EQ(chosen.hole["method"], "intrinsic-delaunay");
    EXPECT_LT(chosen.hole["surroundings_degrees"]["largest"], 20);
    EXPECT_EQ(chosen.after.X, fill(mesh, {"--laplacian", "intrinsic-delaunay"}).after.X);
    EXPECT_LT(sphere_error(mesh, chosen.after),
              1e-3 * (1 - std::cos(degrees * std::numbers::pi / 180)));
  }
}

TEST_F(FillChoice, WellMeshedDetailsAreContinued) {
  Mesh mesh = without_cap(sphere(4), 20);
  const Points unit = mesh.X;
  for (auto x : mesh.X.rowwise()) {
    x *= 1 + 0.1 * std::sin(5 * x[0]) * std::cos(4 * x[1]);
  }
  const auto error = [](const Mesh& after, Eigen::Index before) {
    double sum = 0;
    const Eigen::Index count = after.X.rows() - before;
    for (auto x : after.X.bottomRows(count).rowwise()) {
      // The radius depends on the point of the unit sphere in the same direction.
      const Vec3 direction = x.transpose().normalized();
      const double radius = 1 + 0.1 * std::sin(5 * direction[0]) * std::cos(4 * direction[1]);
      sum += std::pow(x.norm() - radius, 2);
    }
    return std::sqrt(sum / static_cast<double>(count));
  };
  const Filled chosen = fill(mesh);
  EXPECT_EQ(chosen.hole["surroundings"]["kind"], "shaped") << chosen.hole;
  EXPECT_EQ(chosen.hole["method"], "intrinsic-delaunay with continued curvature");
  EXPECT_EQ(chosen.after.X.topRows(mesh.X.rows()), mesh.X);
  const Filled faired = fill(mesh, {"--laplacian", "intrinsic-delaunay"});
  EXPECT_LT(error(chosen.after, unit.rows()), 0.7 * error(faired.after, unit.rows()));
}

TEST_F(FillChoice, DoesNotDependOnSizeAndPlace) {
  for (const double noise : {0.0, 0.1}) {
    const Mesh mesh = noisy_sphere(4, 30, noise, 5);
    const json there = fill(mesh).hole;
    for (const double scale : {1e-8, 1e8}) {
      SCOPED_TRACE(fmt::format("noise {}, scale {}", noise, scale));
      Mesh moved = mesh;
      moved.X = scale * (mesh.X.array() + 10).matrix();
      const json hole = fill(moved).hole;
      EXPECT_EQ(hole["surroundings"]["kind"], there["surroundings"]["kind"]);
      EXPECT_NEAR(hole["surroundings"]["roughness"].get<double>(),
                  there["surroundings"]["roughness"].get<double>(), 1e-6);
      EXPECT_EQ(hole["method"], there["method"]);
    }
  }
}

TEST_F(FillChoice, AnOptionWins) {
  const Mesh mesh = noisy_sphere(4, 30, 0.1, 1);
  for (const char* laplacian : {"lagrange", "intrinsic-delaunay", "crouzeix-raviart"}) {
    const Filled filled = fill(mesh, {"--laplacian", laplacian});
    EXPECT_EQ(filled.hole["method"], laplacian);
    EXPECT_FALSE(filled.hole.contains("surroundings"));
  }
  EXPECT_EQ(fill(mesh, {"--rim-smooth", "auto"}).after.X, fill(mesh).after.X);
  const Filled filled = fill(mesh, {"--mass", "voronoi"});
  EXPECT_EQ(filled.hole["method"], "lagrange");
  EXPECT_FALSE(filled.hole.contains("surroundings"));
}

TEST_F(FillChoice, NoiseIsNotTakenForDirections) {
  double chosen = 0, fixed = 0, moved = 0;  // sums of logarithms of errors
  int noisy = 0, all = 0;
  for (const double degrees : {12.0, 20.0, 45.0}) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      const Mesh mesh = noisy_sphere(4, degrees, 0.1, seed);
      const Filled filled = fill(mesh);
      EXPECT_EQ(filled.after.X.topRows(mesh.X.rows()), mesh.X);
      noisy += filled.hole["surroundings"]["kind"] == "noisy" ? 1 : 0;
      ++all;
      chosen += std::log(sphere_error(mesh, filled.after));
      fixed += std::log(sphere_error(mesh, fill(mesh, {"--laplacian", "lagrange"}).after));
      moved += std::log(
          sphere_error(mesh, fill(mesh, {"--laplacian", "lagrange", "--rim-smooth", "2"}).after));
    }
  }
  EXPECT_GE(noisy, 0.7 * all);
  EXPECT_LT(std::exp((chosen - std::min(fixed, moved)) / all), 1.1);
}

TEST_F(FillChoice, PlanesBesideCreasesStayPlanes) {
  // A hole in a face of a cube; the edge of the cube is within three rings of its rim.
  Mesh cube = make_shape("cube", {.subdivide = 4});
  std::vector<Index> gone;
  const double top = cube.X.col(2).maxCoeff();
  for (Index f = 0; f < cube.faces.size(); ++f) {
    Vec3 middle = Vec3::Zero();
    const auto corners = cube.faces[f];
    for (const Index v : corners) {
      middle += cube.X.row(v).transpose() / static_cast<double>(corners.size());
    }
    if (middle[2] > top * (1 - 1e-9) && middle[0] > 0.3 * top && middle[0] < 0.8 * top &&
        std::abs(middle[1]) < 0.4 * top) {
      gone.push_back(f);
    }
  }
  const Mesh mesh = without_triangles(cube, gone);
  const Filled filled = fill(mesh);
  EXPECT_GT(filled.hole["new_triangles"], 0);
  const Points X = filled.after.X.bottomRows(filled.after.X.rows() - mesh.X.rows());
  EXPECT_LT((X.col(2).array() - top).abs().maxCoeff(), 1e-9 * top) << filled.hole;
}

}  // namespace
}  // namespace ibmfair::test
