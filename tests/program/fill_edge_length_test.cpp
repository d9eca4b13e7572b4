// `ibmfair fill --edge-length L` fills holes with triangles whose edges are as long as L.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "ibmfair/fill/holes.h"
#include "ibmfair/io/mesh_file.h"
#include "ibmfair/mesh/geometry.h"
#include "support/holed_meshes.h"
#include "support/run_program.h"
#include "support/states.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {
namespace {

using nlohmann::json;

/// A mesh with one hole to fill.
struct Holed {
  std::string name;
  Mesh mesh;
  std::vector<Index> rim = {};  // of the only hole, or of the largest that is no outer border
  double rim_edge = 0;          // mean edge length along the rim
};

Holed holed(const std::string& name, const Mesh& mesh) {
  Holed result{name, mesh};
  double longest = 0;
  const std::vector<Hole> holes = find_holes(mesh.X, State(mesh).topology);
  for (const Hole& hole : holes) {
    if ((!hole.outer_border || holes.size() == 1) && hole.perimeter > longest) {
      longest = hole.perimeter;
      result.rim = hole.loop;
      result.rim_edge = hole.perimeter / hole.edges();
    }
  }
  return result;
}

class FillEdgeLength : public testing::Test {
 protected:
  struct Filled {
    Mesh after;
    json hole;
    int exit_code = 0;
  };

  Filled fill(const Mesh& mesh, const std::vector<std::string>& options) {
    const std::string in = directory_ / fmt::format("in{}.off", inputs_++),
                      out = directory_ / "out.off";
    write_mesh(mesh, in);
    std::vector<std::string> arguments{"fill", in, out, "--json", "--overwrite"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const RunResult run = run_program(arguments);
    EXPECT_LE(run.exit_code, 1) << run.err;
    Filled filled{read_mesh(out).mesh(), {}, run.exit_code};
    const json told = json::parse(run.out);
    for (const json& hole : told["holes"]) {
      if (hole["new_triangles"] > 0) {
        filled.hole = hole;
      }
    }
    return filled;
  }

  TemporaryDirectory directory_;
  int inputs_ = 0;
};

/// The median length of the patch's edges whose ends are at least `distance` away from the rim.
double median_inside(const Holed& before, const Mesh& after, double distance) {
  const Points rim = before.mesh.X(before.rim, Eigen::all);
  const auto is_inside = [&](Index v) {
    return v >= before.mesh.X.rows() &&
           (rim.rowwise() - after.X.row(v)).rowwise().norm().minCoeff() >= distance;
  };
  std::set<std::pair<Index, Index>> edges;
  for (Index f = before.mesh.faces.size(); f < after.faces.size(); ++f) {
    const auto x = after.faces[f];
    for (int i = 0; i < 3; ++i) {
      edges.insert(std::minmax(x[i], x[(i + 1) % 3]));
    }
  }
  std::vector<double> lengths;
  for (const auto& [a, b] : edges) {
    if (is_inside(a) && is_inside(b)) {
      lengths.push_back((after.X.row(a) - after.X.row(b)).norm());
    }
  }
  EXPECT_GE(lengths.size(), 10u);
  std::nth_element(lengths.begin(), lengths.begin() + std::ssize(lengths) / 2, lengths.end());
  return lengths.empty() ? 0 : lengths[lengths.size() / 2];
}

TEST_F(FillEdgeLength, EdgesInsideThePatchHaveTheLength) {
  const std::vector<Holed> meshes{
      holed("cap", without_cap(sphere(5), 40)), holed("half", without_cap(sphere(4), 90)),
      holed("rest", without_cap(sphere(4), 130)),
      holed("square", with_square_hole(flat_sheet(60, 60), 34)),
      holed("large cap", moved(without_cap(sphere(5), 50), 1e6, Vec3(1e7, 0, 0)))};
  for (const Holed& before : meshes) {
    for (const double factor : {0.25, 0.6, 1.0, 1.7, 4.0}) {
      SCOPED_TRACE(fmt::format("{}, {} edges", before.name, factor));
      const double length = factor * before.rim_edge;
      const Filled filled = fill(before.mesh, {"--edge-length", fmt::format("{}u", length),
                                               before.name == "rest" ? "--all" : "--quiet"});
      EXPECT_EQ(filled.exit_code, 0);
      EXPECT_EQ(filled.hole["status"], "filled");
      const double distance = 2 * std::max(0.0, length - before.rim_edge) + before.rim_edge;
      EXPECT_NEAR(median_inside(before, filled.after, distance) / length, 1, 0.2);
    }
  }
}

TEST_F(FillEdgeLength, ShapesStayExact) {
  for (const double factor : {0.3, 0.7, 1.0}) {
    const Mesh mesh = without_cap(sphere(4), 40);
    const Points X = fill(mesh, {"--edge-length", fmt::format("{}e", factor)}).after.X;
    EXPECT_LT((X.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-3) << factor;
  }
}

TEST_F(FillEdgeLength, AllUnitsAgree) {
  const Mesh mesh = without_cap(sphere(4), 40);
  const double edge = mean_edge_length(mesh.X, State(mesh).topology.E);
  const double diagonal = bounding_box_size(mesh.X).norm();
  const Points X = fill(mesh, {"--edge-length", "1.5e"}).after.X;
  for (const std::string& length : {fmt::format("{}", 1.5 * edge), fmt::format("{}u", 1.5 * edge),
                                    fmt::format("{}%", 1.5 * edge / diagonal * 100)}) {
    const Points other = fill(mesh, {"--edge-length", length}).after.X;
    ASSERT_EQ(other.rows(), X.rows()) << length;
    EXPECT_LT((other - X).cwiseAbs().maxCoeff(), 1e-6) << length;
  }
}

TEST_F(FillEdgeLength, TheLimitOfNewVerticesHolds) {
  const Mesh mesh = without_cap(sphere(4), 40);
  const Filled filled = fill(mesh, {"--edge-length", "0.1e", "--max-new-vertices", "300"});
  EXPECT_EQ(filled.exit_code, 1);
  EXPECT_EQ(filled.hole["status"], "coarse");
  EXPECT_LE(filled.after.X.rows(), mesh.X.rows() + 300);
  EXPECT_TRUE(State(filled.after).topology.boundary_loops.empty());
}

TEST_F(FillEdgeLength, BadValuesAreRefused) {
  const std::string in = directory_ / "in.off", out = directory_ / "out.off";
  write_mesh(without_cap(sphere(2), 40), in);
  const std::vector<std::pair<std::vector<std::string>, std::string>> bad{
      {{"--edge-length", "0"}, "positive length"},
      {{"--edge-length", "-1"}, "positive length"},
      {{"--edge-length", "nan"}, "positive length"},
      {{"--edge-length", "long"}, "positive length"},
      {{"--edge-length", "1e-12"}, "too short for this mesh"},
      {{"--edge-length", "1e", "--no-refine"}, "--no-refine cannot be combined with --edge-length"},
      {{"--edge-length", "1e", "--region", "@all"},
       "--region cannot be combined with --edge-length"}};
  for (const auto& [options, message] : bad) {
    std::vector<std::string> arguments{"fill", in, out};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const RunResult run = run_program(arguments);
    EXPECT_EQ(run.exit_code, 2) << options[1];
    EXPECT_TRUE(contains(run.err, message)) << run.err;
    EXPECT_FALSE(std::filesystem::exists(out));
  }
}

}  // namespace
}  // namespace ibmfair::test
