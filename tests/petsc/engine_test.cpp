// Laws of the PETSc engine that hold for any number of ranks, checked with the real program.
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "ibmfair/io/mesh_file.h"
#include "ibmfair/shapes/shapes.h"
#include "petsc/ranks.h"
#include "support/files.h"
#include "support/mesh_io.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

constexpr double same = 1e-8;  // relative to the mesh's size

Mesh noisy(Mesh mesh, double amount = 0.15) {
  mesh.X = shaken(State(mesh), amount);
  return mesh;
}

Mesh noisy_torus() {
  return noisy(make_shape("torus", {.rows = 12}));
}

Mesh noisy_sheet() {
  return noisy(flat_sheet(14, 11));
}

class Ranks : public RanksTest {
 protected:
  void expect_the_same(const std::string& input, const Words& options, int ranks,
                       const std::string& what) const {
    const Fair one = on_one(input, options);
    const Fair several = on_ranks(ranks, input, options);
    ASSERT_EQ(one.run.exit_code, several.run.exit_code) << what << several.run.err;
    ASSERT_FALSE(several.bytes.empty()) << what;
    EXPECT_LT(relative_difference(one.X(), several.X()), same) << what << ", ranks " << ranks;
  }
};

TEST_F(Ranks, EveryNumberGivesTheMeshOfOneProcess) {
  for (const Mesh& mesh : {noisy_torus(), noisy_sheet()}) {
    const std::string input = file_of(mesh);
    for (const int ranks : {1, 2, 3, 4}) {
      expect_the_same(input, {"--steps", "4"}, ranks, "noisy");
    }
  }
}

TEST_F(Ranks, DefaultsAreThoseOfOneProcess) {
  const Words smooth{"smooth",  file_of(noisy_torus()), files_ / "out.ply", "--json",
                     "--quiet", "--overwrite"};
  for (const Words& options : {Words{}, Words{"--cutoff", "4"}, Words{"--plain"}}) {
    const nlohmann::json one = nlohmann::json::parse(run_program(smooth + options).out)["options"];
    const RunResult run = run_on_ranks(2, smooth + Words{"--engine", "petsc"} + options);
    const nlohmann::json several = nlohmann::json::parse(run.out)["options"];
    EXPECT_EQ(one["steps"], several["steps"]);
    EXPECT_EQ(one["solver_tolerance"], several["solver_tolerance"]);
    const double cutoff = one["cutoff"];
    EXPECT_NEAR(several["cutoff"].get<double>(), cutoff, 1e-12 * cutoff);
  }
}

TEST_F(Ranks, AllMeshesOfTheTestsEndAsOnOneProcess) {
  for (const NamedMesh& mesh : all_meshes()) {
    if (mesh.name == "Moebius strip" || mesh.name == "Klein bottle") {
      continue;  // the place of the cut is arbitrary
    }
    expect_the_same(file_of(mesh.mesh), {"--steps", "2", "--cutoff", "4"}, 3, mesh.name);
  }
}

TEST_F(Ranks, NeedlesDoNotTellThemApart) {
  Mesh mesh = in_triangles(noisy_torus());
  mesh.X = with_needle(State(mesh), 50, 1e-9);
  const std::string input = file_of(mesh);
  for (const int ranks : {1, 2, 3}) {
    expect_the_same(input, {"--steps", "4"}, ranks, "needle");
  }
}

TEST_F(Ranks, EveryOptionOfTheFlowMeansTheSame) {
  const std::string torus = file_of(noisy_torus(), "torus.ply");
  const std::string sheet = file_of(noisy_sheet(), "sheet.ply");
  const std::string list = files_ / "list.txt";
  write_bytes(list, "0 5 17 40");
  for (const Words& options : std::vector<Words>{
           {"--laplacian", "lagrange"},
           {"--laplacian", "lagrange", "--mass", "voronoi"},
           {"--laplacian", "umbrella"},
           {"--laplacian", "lagrange", "--h0", "0.5"},
           {"--laplacian", "lagrange", "--anisotropy", "1,0,0,2"},
           {"--no-mass"},
           {"--no-mass", "--laplacian", "lagrange"},
           {"--metric", "identity"},
           {"--newton-iterations", "2"},
           {"--tangential", "none"},
           {"--keep-sharp", "40"},
           {"--twicing", "2"},
           {"--laplacian", "umbrella", "--twicing", "1"},
           {"--max-move", "0.1e"},
           {"--fix", list},
           {"--cutoff", "5%"},
           {"--plain"},
       }) {
    const Words all = Words{"--steps", "3"} + options;
    std::string what;
    for (const std::string& word : all) {
      what += word + " ";
    }
    expect_the_same(torus, all, 2, "torus " + what);
    expect_the_same(sheet, all, 2, "sheet " + what);
  }
}

TEST_F(Ranks, BoundariesAreHeldAsOnOneProcess) {
  const std::string sheet = file_of(noisy_sheet());
  for (const char* boundary : {"fixed", "position", "free"}) {
    expect_the_same(sheet, {"--boundary", boundary, "--steps", "3"}, 3, boundary);
  }
}

TEST_F(Ranks, FiguresAreThoseOfTheWholeMesh) {
  for (const Mesh& mesh : {noisy_torus(), noisy_sheet()}) {
    const std::string input = file_of(mesh);
    const nlohmann::json one = on_one(input, {"--steps", "3"}).report;
    const nlohmann::json several = on_ranks(3, input, {"--steps", "3"}).report;
    for (const char* state : {"before", "after"}) {
      for (const char* figure :
           {"energy", "area", "volume", "smallest_angle_degrees", "folded_hinges"}) {
        const double expected = one[state][figure];
        EXPECT_NEAR(several[state][figure], expected, 1e-7 * (1 + std::abs(expected)))
            << state << " " << figure;
      }
    }
    for (const char* figure : {"largest_move", "rms_move", "moved_vertices"}) {
      EXPECT_NEAR(several[figure], one[figure].get<double>(), 1e-7) << figure;
    }
    for (const char* count : {"vertices", "triangles", "unknowns"}) {
      EXPECT_EQ(several["mesh"][count], one["mesh"][count]);
    }
    EXPECT_EQ(several["steps"].size(), one["steps"].size());
  }
}

TEST_F(Ranks, NameDefectsByTheirNumbersInTheFile) {
  for (const NamedMesh& mesh : defective_meshes()) {
    const std::string input = file_of(mesh.mesh);
    const nlohmann::json one = on_one(input, {"--steps", "1"}).report;
    const nlohmann::json several = on_ranks(3, input, {"--steps", "1"}).report;
    EXPECT_EQ(several["defects"], one["defects"]) << mesh.name;
    EXPECT_EQ(several["warnings"].empty(), one["warnings"].empty()) << mesh.name;
    const RunResult strict = run_on_ranks(2, {"smooth", input, files_ / "strict.ply", "--engine",
                                              "petsc", "--strict", "--overwrite"});
    EXPECT_EQ(strict.exit_code, one["warnings"].empty() ? 0 : 4) << mesh.name;
  }
}

TEST_F(Ranks, HaveNearlyEvenParts) {
  const std::string input = file_of(noisy(make_shape("torus", {.rows = 40})));
  for (const int ranks : {2, 3, 4}) {
    const nlohmann::json report = on_ranks(ranks, input, {"--steps", "1"}).report;
    ASSERT_EQ(report["ranks"].size(), static_cast<std::size_t>(ranks));
    double largest = 0, sum = 0;
    for (const nlohmann::json& rank : report["ranks"]) {
      largest = std::max(largest, rank["vertices"].get<double>());
      sum += rank["vertices"].get<double>();
    }
    EXPECT_EQ(sum, report["mesh"]["vertices"]);
    EXPECT_LT(largest, 1.15 * sum / ranks) << ranks;
  }
}

TEST_F(Ranks, MayBeMoreThanVertices) {
  const std::string input = file_of(closed_meshes().front().mesh);
  expect_the_same(input, {"--steps", "2"}, 6, "tetrahedron");
}

TEST_F(Ranks, TakeTheOptionsOfPetsc) {
  const std::string input = file_of(noisy_torus());
  const Fair few = on_ranks(2, input, {"--steps", "2"}, {"-ksp_max_it", "1"});
  const Fair exact = on_ranks(2, input, {"--steps", "2"});
  const Fair direct = on_ranks(
      2, input, {"--steps", "2"},
      {"-ksp_type", "preonly", "-pc_type", "cholesky", "-pc_factor_mat_solver_type", "mumps"});
  EXPECT_EQ(few.report["flow"]["iterations"], 3 * few.report["flow"]["solves"].get<int>());
  EXPECT_GT(exact.report["flow"]["iterations"], few.report["flow"]["iterations"]);
  EXPECT_LT(relative_difference(exact.X(), direct.X()), same);
  const Fair mumps = on_ranks(2, input, {"--steps", "2", "--solver", "mumps"});
  EXPECT_LT(relative_difference(exact.X(), mumps.X()), same);
  EXPECT_EQ(exact.report["flow"]["factorizations"], 0);
  EXPECT_GT(mumps.report["flow"]["factorizations"], 0);
}

TEST_F(Ranks, FactorAgainWhereTheSpaceWasTooSmall) {
  const std::string input = file_of(noisy_torus());
  const Words settings{"--steps", "2", "--solver", "mumps"};
  const Fair ample = on_ranks(2, input, settings);
  const Fair short_of_it = on_ranks(2, input, settings, {"-mat_mumps_icntl_14", "-90"});
  EXPECT_EQ(short_of_it.report["status"], "completed");
  EXPECT_LT(relative_difference(ample.X(), short_of_it.X()), same);
}

TEST_F(Ranks, NeedNoMpirunForOne) {
  const std::string input = file_of(noisy_torus());
  const RunResult run =
      run_program({"smooth", input, files_ / "out.ply", "--engine", "petsc", "--steps", "2"},
                  {.environment = mpi_environment()});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(std::filesystem::exists(files_ / "out.ply"));
}

}  // namespace
}  // namespace ibmfair::test
