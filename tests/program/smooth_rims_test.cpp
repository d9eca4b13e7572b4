// Open boundaries in `smooth`, through the real program.
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "ibmfair/io/mesh_file.h"
#include "support/files.h"
#include "support/mesh_io.h"
#include "support/meshes.h"
#include "support/run_program.h"
#include "support/states.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {
namespace {

using nlohmann::json;

class SmoothRims : public testing::Test {
 protected:
  std::string made(const std::string& shape, const std::string& name, const Words& options) {
    std::string path = files_ / name;
    const RunResult run = run_program(Words{"make", shape, path, "--overwrite"} + options);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return path;
  }

  /// The positions after `smooth` with these options.
  Points smooth(const std::string& input, const Words& options) {
    const std::string output = files_ / "out.ply";
    const RunResult run =
        run_program(Words{"smooth", input, output, "--overwrite", "--json"} + options);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    report_ = json::parse(run.out, nullptr, false);
    return read_mesh(output).mesh().X;
  }

  TemporaryDirectory files_;
  json report_;
};

/// The root mean square of the distances of vertices from the surface of a cylinder about the z
/// axis with radius 1 and |z| <= 1. `inner`: those of vertices more than five rings from the rims;
/// else those of nearer ones.
double off_cylinder(const Points& X, const Topology& topology, bool inner) {
  std::vector<Index> rims;
  for (const BoundaryLoop& loop : topology.boundary_loops) {
    rims.insert(rims.end(), loop.vertices.begin(), loop.vertices.end());
  }
  const auto near = around(topology, rims, 5);
  double sum = 0, count = 0;
  for (Index v = 0; v < X.rows(); ++v) {
    if ((near[v] == 0) == inner) {
      const double radial = std::hypot(X(v, 0), X(v, 1)) - 1;
      const double beyond = std::max(std::abs(X(v, 2)) - 1, 0.0);
      sum += radial * radial + beyond * beyond;
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

/// The root mean square of the second differences along the rims.
double jaggedness(const Points& X, const Topology& topology) {
  double sum = 0, count = 0;
  for (const BoundaryLoop& loop : topology.boundary_loops) {
    const auto& v = loop.vertices;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const Index before = v[(i + v.size() - 1) % v.size()], after = v[(i + 1) % v.size()];
      sum += (X.row(before) - 2 * X.row(v[i]) + X.row(after)).squaredNorm();
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

TEST_F(SmoothRims, DenoiseRemovesTheNoiseOfRimsAsElsewhere) {
  const Words shape{"--rows", "40", "--columns", "100"};
  const State truth(read_mesh(made("cylinder", "truth.ply", shape)).mesh());
  for (const char* noise : {"0.1", "0.3"}) {
    SCOPED_TRACE(noise);
    const std::string input = made("cylinder", "noisy.ply", shape + Words{"--noise", noise});
    const Points noisy = read_mesh(input).mesh().X, denoised = smooth(input, {"--denoise"});
    const double clean = jaggedness(truth.X, truth.topology);
    EXPECT_LT(jaggedness(denoised, truth.topology) - clean,
              (jaggedness(noisy, truth.topology) - clean) / 5);
    // A curve has fewer vertices to average over than a surface, above all with long cut-offs.
    EXPECT_LT(off_cylinder(denoised, truth.topology, false),
              2 * off_cylinder(denoised, truth.topology, true));
    EXPECT_LT(off_cylinder(denoised, truth.topology, false),
              0.35 * off_cylinder(noisy, truth.topology, false));
    // As before, on request.
    const Points fixed = smooth(input, {"--denoise", "--boundary", "fixed"});
    for (Index v = 0; v < noisy.rows(); ++v) {
      if (truth.topology.kind[v] == VertexKind::boundary) {
        EXPECT_EQ(fixed.row(v), noisy.row(v));
      }
    }
  }
}

TEST_F(SmoothRims, DenoiseLeavesOpenMeshesWithoutNoiseAsTheyAre) {
  for (const char* shape : {"cylinder", "catenoid", "plane"}) {
    const std::string input = made(shape, "clean.ply", {"--rows", "30"});
    smooth(input, {"--denoise"});
    EXPECT_EQ(read_bytes(files_ / "out.ply"), read_bytes(input)) << shape;
  }
}

/// The border of rounded heights is exact, and stays in place.
TEST_F(SmoothRims, DenoiseKeepsTheBorderOfHeightsInSteps) {
  Mesh mesh = flat_sheet(60, 60);
  for (Index v = 0; v < mesh.X.rows(); ++v) {
    const double x = mesh.X(v, 0), y = mesh.X(v, 1);
    mesh.X(v, 2) = std::round(10 * std::sin(3 * x) * std::cos(2.5 * y)) / 60;
  }
  const std::string input = files_ / "heights.off";
  write_mesh(mesh, input);
  const Points X = smooth(input, {"--denoise"});
  EXPECT_EQ(report_["cutoff_choice"]["kind"], "steps");
  double moved = 0;
  const State state(mesh);
  for (Index v = 0; v < X.rows(); ++v) {
    moved = std::max(moved, (X.row(v) - mesh.X.row(v)).norm());
    if (state.topology.kind[v] == VertexKind::boundary) {
      EXPECT_EQ(X.row(v), mesh.X.row(v));
    }
  }
  EXPECT_GT(moved, 0);
}

TEST_F(SmoothRims, FairBoundariesAreSmoothedAlongThemselves) {
  const Words shape{"--rows", "20", "--columns", "60"};
  const State truth(read_mesh(made("cylinder", "truth.ply", shape)).mesh());
  const std::string input = made("cylinder", "noisy.ply", shape + Words{"--noise", "0.2"});
  const double before = jaggedness(read_mesh(input).mesh().X, truth.topology);
  for (const Words& laplacian : {Words{}, Words{"--laplacian", "umbrella"}}) {
    const auto after = [&](const char* boundary) {
      return jaggedness(smooth(input, Words{"--boundary", boundary} + laplacian), truth.topology);
    };
    EXPECT_EQ(after("fixed"), before);
    EXPECT_LT(after("fair"), 0.3 * before);
    EXPECT_LT(after("fair"), 0.7 * after("free"));
  }
  const Points noisy = read_mesh(input).mesh().X;
  const double most = 0.01;
  const Points bounded =
      smooth(input, {"--boundary", "fair", "--max-move", fmt::format("{}", most)});
  EXPECT_LE((bounded - noisy).rowwise().norm().maxCoeff(), most * (1 + 1e-9));
}

}  // namespace
}  // namespace ibmfair::test
