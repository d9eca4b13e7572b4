// `ibmfair info`: the figures that the program reports about meshes.
#include <numbers>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/program_figures.h"
#include "support/run_program.h"

namespace ibmfair {
namespace {

using nlohmann::json;
using test::contains;
using test::figures;
using test::info_of;
using test::made;
using test::run_program;
using test::RunResult;
using test::Words;
using test::operator+;
using std::numbers::pi;

TEST(Info, IcospheresApproachTheSphereAtSecondOrder) {
  double last_area = 0.0;
  double last_energy = 0.0;
  for (int level = 3; level <= 5; ++level) {
    const json found = info_of({"icosphere", "--subdivide", std::to_string(level)});
    const double area = 4.0 * pi - found["area"].get<double>();
    const double energy = 8.0 * pi - found["bending_energy"]["lagrange"].get<double>();
    if (level > 3) {
      EXPECT_NEAR(last_area / area, 4.0, 0.05);
      EXPECT_NEAR(last_energy / energy, 4.0, 0.05);
    }
    last_area = area;
    last_energy = energy;
    EXPECT_NEAR(found["bending_energy"]["crouzeix-raviart"], 8.0 * pi + 0.385, 0.01);
    EXPECT_EQ(found["vertices"], 10 * (1 << (2 * level)) + 2);
    EXPECT_EQ(found["hinges"], found["edges"]);
    EXPECT_EQ(found["genus"], 0);
    EXPECT_EQ(found["closed"], true);
  }
}

TEST(Info, CliffordToriApproachTheirEnergyWhateverTheTriangles) {
  for (const Words& grid : {Words{}, Words{"--straight"}}) {
    double last = 0.0;
    for (const int rows : {16, 32, 64}) {
      const json found = info_of(Words{"torus", "--rows", std::to_string(rows)} + grid);
      EXPECT_EQ(found["genus"], 1);
      const double error = 4.0 * pi * pi - found["bending_energy"]["lagrange"].get<double>();
      if (last != 0.0) {
        EXPECT_NEAR(last / error, 4.0, 0.5);
      }
      last = error;
    }
  }
}

TEST(Info, FlatShapesHaveNoEnergyAndOneBoundary) {
  for (const std::string shape : {"plane", "hexagon"}) {
    const json found = info_of({shape});
    EXPECT_EQ(found["boundary_loops"], 1);
    EXPECT_EQ(found["closed"], false);
    EXPECT_TRUE(found["volume"].is_null());
    for (const auto& [model, energy] : found["bending_energy"].items()) {
      EXPECT_LE(energy.get<double>(), 1e-20) << shape << " " << model;
    }
  }
  EXPECT_EQ(info_of({"cylinder"})["boundary_loops"], 2);
}

TEST(Info, TellsTheEndsOfTheSpectrumOfTheLaplacianThatIsAskedFor) {
  const std::string ball = made({"icosphere", "--subdivide", "3"});
  EXPECT_FALSE(figures({"info", "-"}, {.input = ball}).contains("operator"));
  const json found = figures({"info", "-", "--laplacian", "lagrange", "--mass", "galerkin"},
                             {.input = ball})["operator"];
  EXPECT_EQ(found["laplacian"], "lagrange");
  EXPECT_EQ(found["mass"], "galerkin");
  EXPECT_EQ(found["nodes"], 642);
  EXPECT_EQ(found["zero_eigenvalues"], 1);
  EXPECT_NEAR(found["bending_energy"], 8.0 * pi, 0.1);
  EXPECT_NEAR(found["smallest_eigenvalue"], 2.0, 0.02);  // l (l + 1)
  EXPECT_GT(found["largest_eigenvalue"], 1000);
  const json defaults = figures({"info", "-", "--laplacian", "umbrella"}, {.input = ball});
  EXPECT_EQ(defaults["operator"]["mass"], "valence");
  const RunResult refused =
      run_program({"info", "-", "--laplacian", "umbrella", "--mass", "voronoi"}, {.input = ball});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("barycentric"), std::string::npos);
}

TEST(Info, FitsASphere) {
  const json found = figures(
      {"info", "-", "--sphere"},
      {.input = made({"icosphere", "--subdivide", "3", "--scale", "2", "--move", "5,6,7"})});
  EXPECT_NEAR(found["sphere"]["radius"], 2.0, 1e-13);
  EXPECT_NEAR(found["sphere"]["center"][2], 7.0, 1e-12);
  EXPECT_LE(found["sphere"]["relative_deviation"], 1e-14);
  // The twelve corners of the icosahedron are on the sphere; the midpoints of its edges are not.
  const json flat =
      figures({"info", "-", "--sphere"}, {.input = made({"icosahedron", "--subdivide", "4"})});
  EXPECT_GT(flat["sphere"]["relative_deviation"], 0.03);
}

TEST(Info, TheTableForPeopleNamesEveryFigure) {
  const RunResult result = run_program({"info", "-", "--sphere"}, {.input = made({"icosphere"})});
  EXPECT_EQ(result.exit_code, 0);
  for (const std::string label :
       {"vertices", "faces", "edges", "components", "genus", "boundary loops", "defects",
        "edge length", "smallest angle", "area", "volume", "bounding box", "E_b crouzeix-raviart",
        "E_b lagrange", "radius deviation"}) {
    EXPECT_TRUE(contains(result.out, "\n" + label + " ")) << label;
  }
}

}  // namespace
}  // namespace ibmfair
