// `ibmfair fill` on surfaces whose true patch is known and, if the collection of real meshes is
// present, on real scans.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "ibmfair/fill/fill_holes.h"
#include "ibmfair/io/mesh_file.h"
#include "support/files.h"
#include "support/holed_meshes.h"
#include "support/run_program.h"
#include "support/states.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {
namespace {

using nlohmann::json;

/// Caps are cut from an icosphere of 10,242 vertices. The bounds are for the largest radial error
/// over the cap's height.
TEST(FillExact, SphericalCaps) {
  const std::pair<double, double> bounds[] = {{20, 0.006}, {45, 0.0025}, {90, 0.003}};
  for (const auto& [degrees, bound] : bounds) {
    SCOPED_TRACE(degrees);
    const State state(without_cap(sphere(5), degrees));
    const Filling filling = fill_holes(state.X, state.topology, {}, {});
    const double height = 1 - std::cos(degrees * std::numbers::pi / 180);
    EXPECT_LT((filling.new_X.rowwise().norm().array() - 1).abs().maxCoeff(), bound * height);
    EXPECT_EQ(filling.holes[0].status, HoleStatus::filled);
    EXPECT_EQ(filling.holes[0].seam.folds + filling.holes[0].intersections, 0);
  }
}

struct SharedFile {
  const char* name;
  int exit_code;
  bool closed;
  std::vector<std::string> options;
};

TEST(FillShared, ScansCloseToManifolds) {
  const TemporaryDirectory directory;
  // The boundaries of the elephant's holes pass some points twice, as different vertices.
  const SharedFile files[] = {
      {"stanford-bunny_69k_5holes_alec.obj", 0, true, {}},
      {"mech-holes-shark_cgal.off", 0, true, {}},
      {"elephant-with-holes_cgal.off", 0, true, {"--weld"}},
      {"elephant-with-holes_cgal.off", 1, true, {}},
      {"fairing-cross_pmp.off", 0, true, {}},
      {"hexagon_6k_gpjs.obj", 0, false, {}},
  };
  for (const SharedFile& file : files) {
    const auto path = shared_mesh(std::string("holes/") + file.name);
    if (!path) {
      GTEST_SKIP() << "no ../shared/meshes";
    }
    SCOPED_TRACE(file.name);
    const std::string out = directory / (std::string("out-") + file.name);
    std::vector<std::string> words{"fill", *path, out, "--json", "--overwrite"};
    words.insert(words.end(), file.options.begin(), file.options.end());
    const RunResult run = run_program(words);
    EXPECT_EQ(run.exit_code, file.exit_code) << run.err;
    const json report = json::parse(run.out);
    for (const json& hole : report["holes"]) {
      EXPECT_TRUE(hole["status"] == "filled" || !hole["reason"].get<std::string>().empty());
    }
    const State filled(read_mesh(out).mesh());
    EXPECT_EQ(filled.topology.boundary_loops.empty(), file.closed);
    EXPECT_TRUE(filled.topology.defects.empty());
  }
}

}  // namespace
}  // namespace ibmfair::test
