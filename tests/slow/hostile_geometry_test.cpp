// Difficult geometry: the program never crashes, hangs, or writes NaN or infinite numbers, and it
// reports every outcome.
#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "ibmfair/io/mesh_file.h"
#include "support/hostile_meshes.h"
#include "support/run_program.h"
#include "support/solvers.h"
#include "support/states.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {
namespace {

using nlohmann::json;

class HostileGeometry : public testing::Test {
 protected:
  RunResult run(const std::string& command, const Mesh& mesh, const Words& options = {}) {
    std::filesystem::remove(in_);
    std::filesystem::remove(out_);
    write_mesh(mesh, in_);
    return run_program(Words{command, in_, out_, "--json"} + options);
  }

  /// Checks what `smooth` and `fill` promise about the vertices and faces of the input mesh.
  void expect_whole(const Mesh& mesh) const {
    const Mesh result = read_mesh(out_).mesh();  // refuses numbers that are not finite
    ASSERT_GE(result.X.rows(), mesh.X.rows());
    ASSERT_GE(result.faces.corner.size(), mesh.faces.corner.size());
    EXPECT_TRUE(std::equal(mesh.faces.corner.begin(), mesh.faces.corner.end(),
                           result.faces.corner.begin()));
  }

  double largest_move(const Mesh& mesh) const {
    return (read_mesh(out_).mesh().X - mesh.X).rowwise().norm().maxCoeff();
  }

  TemporaryDirectory directory_;
  const std::string in_ = directory_ / "in.off", out_ = directory_ / "out.off";
};

TEST_F(HostileGeometry, SmoothEndsWellOrSaysWhyNot) {
  for (const HostileMesh& hostile : hostile_meshes()) {
    std::vector<Words> choices{{}};
    for (const std::string& solver : solvers()) {
      choices.push_back({"--solver", solver});
    }
    for (const Words& options : choices) {
      SCOPED_TRACE(hostile.name + (options.empty() ? "" : " with " + options[1]));
      const RunResult result = run("smooth", hostile.mesh, options);
      EXPECT_TRUE(result.exit_code == hostile.smooth ||
                  (result.exit_code == 0 && hostile.smooth == 1))
          << result.exit_code << " " << result.err;
      EXPECT_EQ(std::filesystem::exists(out_), hostile.smooth < 2);
      if (hostile.smooth >= 2) {
        EXPECT_TRUE(contains(result.err, "error:")) << result.err;
        continue;
      }
      expect_whole(hostile.mesh);
      const json flow = json::parse(result.out)["flow"];
      EXPECT_LE(flow["energy_after"], flow["energy_before"]);
    }
  }
}

TEST_F(HostileGeometry, FillEndsWellOrSaysWhyNot) {
  for (const HostileMesh& hostile : hostile_meshes()) {
    SCOPED_TRACE(hostile.name);
    const RunResult result = run("fill", hostile.mesh, {"--all"});
    EXPECT_EQ(result.exit_code, hostile.fill) << result.err;
    expect_whole(hostile.mesh);
    const json holes = json::parse(result.out)["holes"];
    for (const json& hole : holes) {
      EXPECT_TRUE(hole["status"] == "filled" || !hole["reason"].get<std::string>().empty());
    }
  }
}

TEST_F(HostileGeometry, NeedlesDoNotMakeVerticesFly) {
  // Whatever the angle of the needles, the result has the energy that it has with harmless needles.
  for (const Index every : {40, 6}) {
    const auto energy_after = [&](double degrees, const Words& options) {
      const Mesh mesh = sheet_with_needles(degrees, every);
      const RunResult result = run("smooth", mesh, options);
      EXPECT_EQ(result.exit_code, 0) << result.err;
      EXPECT_LT(largest_move(mesh), 0.1);  // relative to the sheet's size
      return json::parse(result.out)["flow"]["energy_after"].get<double>();
    };
    for (const char* cutoff : {"8", "20"}) {
      const double harmless = energy_after(1, {"--cutoff", cutoff});
      for (const double degrees : {1e-2, 1e-5, 1e-7, 1e-8}) {
        SCOPED_TRACE(testing::Message() << degrees << " degrees, cut-off " << cutoff);
        EXPECT_NEAR(energy_after(degrees, {"--cutoff", cutoff}), harmless, 0.1 * harmless);
      }
    }
  }
}

TEST_F(HostileGeometry, ThePublishedSchemeSurvivesNeedlesOrRefuses) {
  for (const double degrees : {1e-2, 1e-5, 1e-7, 1e-10}) {
    SCOPED_TRACE(degrees);
    const Mesh mesh = sheet_with_needles(degrees, 40);
    const RunResult result = run("smooth", mesh, {"--plain"});
    if (result.exit_code == 0) {
      EXPECT_LT(largest_move(mesh), 0.1);
    } else {
      EXPECT_EQ(result.exit_code, 4);
      EXPECT_TRUE(contains(result.err, "(almost) no area")) << result.err;
      EXPECT_FALSE(std::filesystem::exists(out_));
    }
  }
}

}  // namespace
}  // namespace ibmfair::test
