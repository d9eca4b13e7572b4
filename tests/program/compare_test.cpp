// `ibmfair compare`: the distances between meshes that the program reports.
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/files.h"
#include "support/program_figures.h"
#include "support/run_program.h"
#include "support/temporary_directory.h"

namespace ibmfair {
namespace {

using nlohmann::json;
using test::figures;
using test::made;
using test::run_program;
using test::RunResult;
using test::TemporaryDirectory;
using test::Words;
using test::operator+;

TEST(Compare, ToleranceDecidesTheExitCode) {
  const TemporaryDirectory directory;
  const std::string a = directory / "a.off";
  const std::string b = directory / "b.ply";
  test::write_bytes(a, made({"plane"}));
  test::write_bytes(b, made({"plane", "--move", "0,0,0.125", "--columns", "11"}, "ply"));
  EXPECT_EQ(run_program({"compare", a, a, "--tolerance", "0", "--samples", "999"}).exit_code, 0);
  EXPECT_EQ(run_program({"compare", a, b, "--tolerance", "0.1251", "--samples", "999"}).exit_code,
            0);
  EXPECT_EQ(run_program({"compare", a, b, "--tolerance", "0.1249", "--samples", "999"}).exit_code,
            1);
  const json found = figures({"compare", a, b, "--samples", "999"});
  EXPECT_EQ(found["same_connectivity"], false);
  EXPECT_NEAR(found["surface_distance"]["a_to_b"]["max"], 0.125, 1e-15);
  EXPECT_NEAR(found["surface_distance"]["b_to_a"]["rms"], 0.125, 1e-15);
  EXPECT_NEAR(found["area_ratio"], 1.0, 1e-12);
}

TEST(Compare, MeasuresAgainstExactSurfaces) {
  const json torus = figures({"compare", "-", "--torus", "1,0.4"},
                             {.input = made({"torus", "--ratio", "2.5", "--rows", "32"})});
  EXPECT_LE(torus["exact_surface"]["vertex_distance"]["max"], 1e-15);
  EXPECT_EQ(torus["exact_surface"]["triangle_normal_degrees"]["flipped"], 0);

  const std::string sphere = made({"icosphere", "--subdivide", "3", "--move", "1,0,0"});
  const Words against{"compare", "-", "--sphere"};
  EXPECT_LE(figures(against + Words{"1", "--center", "1,0,0"},
                    {.input = sphere})["exact_surface"]["vertex_distance"]["max"],
            1e-15);
  EXPECT_NEAR(
      figures(against + Words{"1"}, {.input = sphere})["exact_surface"]["vertex_distance"]["max"],
      1.0, 1e-12);
  EXPECT_LE(figures(against + Words{"fit"}, {.input = sphere})["radius_deviation"], 1e-14);
  EXPECT_EQ(run_program(against + Words{"0.5", "--center", "1,0,0", "--tolerance", "0.4"},
                        {.input = sphere})
                .exit_code,
            1);
}

TEST(Compare, DoesNotDependOnTheNumberOfThreads) {
  const TemporaryDirectory directory;
  test::write_bytes(directory / "a.off", made({"torus", "--noise", "0.2"}));
  test::write_bytes(directory / "b.off", made({"torus", "--noise", "0.1", "--straight"}));
  const Words both{"compare", directory / "a.off", directory / "b.off", "--json", "--samples",
                   "3000",    "--threads"};
  const RunResult one = run_program(both + Words{"1"});
  EXPECT_EQ(one.exit_code, 0) << one.err;
  EXPECT_EQ(one.out, run_program(both + Words{"2"}).out);
}

}  // namespace
}  // namespace ibmfair
