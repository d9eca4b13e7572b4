// `ibmfair make`: the shapes that the program generates.
#include <cmath>
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
using test::info_of;
using test::made;
using test::TemporaryDirectory;
using test::Words;
using test::operator+;

TEST(Make, IsReproducibleAndTheSeedMatters) {
  const Words shape{"icosphere", "--subdivide", "3", "--noise", "0.2"};
  const std::string bytes = made(shape);
  EXPECT_EQ(bytes, made(shape + Words{"--threads", "2"}));
  EXPECT_EQ(bytes, made(shape + Words{"--seed", "1"}));
  EXPECT_NE(bytes, made(shape + Words{"--seed", "2"}));
}

TEST(Make, ScalesAndMoves) {
  const json cube = info_of({"cube", "--scale", "1e-3", "--move", "-1,2.5,1e2"});
  EXPECT_NEAR(cube["area"], 24e-6, 1e-15);
  EXPECT_NEAR(cube["bounding_box"]["min"][0], -1.001, 1e-15);
  EXPECT_NEAR(cube["bounding_box"]["max"][1], 2.501, 1e-15);
  EXPECT_NEAR(cube["bounding_box"]["max"][2], 100.001, 1e-13);
}

TEST(Make, NoiseHasTheStandardDeviationAskedFor) {
  const TemporaryDirectory directory;
  const Words shape{"icosphere", "--subdivide", "5", "--scale", "7", "--move", "1,2,3"};
  test::write_bytes(directory / "clean.off", made(shape));
  test::write_bytes(directory / "noisy.off", made(shape + Words{"--noise", "0.3"}));
  const json found =
      figures({"compare", directory / "clean.off", directory / "noisy.off", "--samples", "1"});
  const json& distance = found["vertex_distance"];
  // Noise in three coordinates; the tolerance is five standard errors of 30726 normal numbers.
  EXPECT_NEAR(distance["rms"].get<double>() / distance["mean_edge"].get<double>(),
              0.3 * std::sqrt(3.0), 0.3 * std::sqrt(3.0) * 5.0 / std::sqrt(2.0 * 30726));
}

}  // namespace
}  // namespace ibmfair
