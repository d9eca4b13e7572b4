// `ibmfair fill` on surfaces whose true patch is known and, if the collection of real meshes is
// present, on real scans.
#include <algorithm>
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

/// Fills the holes of a file: each is filled or has a reason, and the result has no defect.
/// `closed` says whether the result is to have no boundary.
void expect_filled(const std::string& path, bool closed, int exit_code = 0,
                   const Words& options = {}) {
  SCOPED_TRACE(path);
  const TemporaryDirectory directory;
  const std::string out = directory / ("out" + path.substr(path.rfind('.')));
  const RunResult run = run_program(Words{"fill", path, out, "--json"} + options);
  EXPECT_EQ(run.exit_code, exit_code) << run.err;
  const json report = json::parse(run.out);
  for (const json& hole : report["holes"]) {
    EXPECT_TRUE(hole["status"] == "filled" || !hole["reason"].get<std::string>().empty());
  }
  const State filled(read_mesh(out).mesh());
  EXPECT_EQ(filled.topology.boundary_loops.empty(), closed);
  EXPECT_TRUE(filled.topology.defects.empty());
}

/// The mesh without the faces around a vertex, except for two opposite ones whose tips are two
/// vertices in one place: the hole passes this place twice.
Mesh with_split_tip(Mesh mesh, Index vertex) {
  std::vector<Index> star;
  for (Index f = 0; f < mesh.faces.size(); ++f) {
    const auto corners = mesh.faces[f];
    if (std::find(corners.begin(), corners.end(), vertex) != corners.end()) star.push_back(f);
  }
  const auto has_common_edge = [&](Index f, Index g) {
    const auto a = mesh.faces[f], b = mesh.faces[g];
    return std::count_if(a.begin(), a.end(),
                         [&](Index v) { return std::find(b.begin(), b.end(), v) != b.end(); }) > 1;
  };
  std::vector<Index> removed(star.begin() + 1, star.end());
  const auto tip = std::find_if(removed.begin(), removed.end(),
                                [&](Index f) { return !has_common_edge(f, star[0]); });
  const auto copy = static_cast<Index>(mesh.X.rows());
  mesh.X.conservativeResize(copy + 1, 3);
  mesh.X.row(copy) = mesh.X.row(vertex);
  const auto corner = mesh.faces.corner.begin() + mesh.faces.first[*tip];
  std::replace(corner, corner + 3, vertex, copy);
  removed.erase(tip);
  return without_triangles(mesh, removed);
}

TEST(FillScans, CloseToManifolds) {
  const TemporaryDirectory directory;
  const auto file = [&](const std::string& name, const Mesh& mesh) {
    write_mesh(mesh, directory / name);
    return directory / name;
  };
  const Mesh bunny = read_mesh(project_file("data/bunny.obj")).mesh();
  const Mesh femur = read_mesh(project_file("data/femur.off")).mesh();
  expect_filled(file("bunny.obj", with_many_holes(bunny)), true);
  expect_filled(file("femur.off", without_cap(femur, 20)), true);
  expect_filled(file("sheet.obj", with_square_hole(flat_sheet(30, 30), 12)), false);
  const std::string split = file("split.off", with_split_tip(bunny, 100));
  expect_filled(split, true, 1);
  expect_filled(split, true, 0, {"--weld"});
}

TEST(FillScans, OfTheSharedCollectionCloseToManifolds) {
  if (shared_meshes("holes").empty()) GTEST_SKIP() << "no ../shared/meshes";
  const auto path = [](const std::string& name) { return shared_mesh("holes/" + name).value(); };
  expect_filled(path("stanford-bunny_69k_5holes_alec.obj"), true);
  expect_filled(path("mech-holes-shark_cgal.off"), true);
  // The boundaries of the elephant's holes pass some points twice, as different vertices.
  expect_filled(path("elephant-with-holes_cgal.off"), true, 0, {"--weld"});
  expect_filled(path("elephant-with-holes_cgal.off"), true, 1);
  expect_filled(path("fairing-cross_pmp.off"), true);
  expect_filled(path("hexagon_6k_gpjs.obj"), false);
}

}  // namespace
}  // namespace ibmfair::test
