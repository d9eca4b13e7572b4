// Errors that come in steps, as people's files have them: the surface of voxels, and heights that
// were rounded to whole numbers. --denoise leaves what is right.
#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "ibmfair/io/mesh_file.h"
#include "support/files.h"
#include "support/run_program.h"
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

}  // namespace
}  // namespace ibmfair::test
