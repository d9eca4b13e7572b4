// Which Laplacian --denoise takes where there are no sharp edges: the linear elements where they
// leave less noise, and never more than the umbrella Laplacian alone would leave.
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/run_program.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {
namespace {

class DenoiseRoundShapes : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return directory_ / name; }

  void make(const Words& words) const {
    const RunResult result =
        run_program(Words{"make", words.front(), path("noisy.ply"), "--overwrite"} +
                    Words(words.begin() + 1, words.end()));
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }

  /// The report of smoothing with these options, with the RMS distance from the exact shape.
  nlohmann::json smooth(const Words& options, const Words& exact) const {
    const Words files{"smooth", path("noisy.ply"), path("out.ply"), "--overwrite", "--json"};
    const RunResult result = run_program(files + options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    nlohmann::json report = nlohmann::json::parse(result.out);
    const RunResult compared = run_program(Words{"compare", path("out.ply"), "--json"} + exact);
    report["error"] =
        nlohmann::json::parse(compared.out)["exact_surface"]["vertex_distance"]["rms"];
    return report;
  }

  const Words umbrella_{"--cutoff", "auto", "--laplacian", "umbrella", "--twicing",    "1",
                        "--steps",  "8",    "--boundary",  "fair",     "--keep-volume"};
  TemporaryDirectory directory_;
};

TEST_F(DenoiseRoundShapes, SpheresComeOutCloserThanWithTheUmbrellaLaplacian) {
  for (const std::string noise : {"0.1", "0.3"}) {
    for (const std::string scale : {"1", "1e-6"}) {
      SCOPED_TRACE(noise + " " + scale);
      make({"icosphere", "--subdivide", "4", "--noise", noise, "--scale", scale});
      const Words sphere{"--sphere", scale};
      const nlohmann::json report = smooth({"--denoise"}, sphere);
      EXPECT_EQ(report["options"]["laplacian"], "lagrange");
      EXPECT_LT(report["error"].get<double>(),
                0.8 * smooth(umbrella_, sphere)["error"].get<double>());
    }
  }
}

TEST_F(DenoiseRoundShapes, ToriComeOutNoWorseThanWithTheUmbrellaLaplacian) {
  for (const std::string noise : {"0.1", "0.2", "0.4"}) {
    SCOPED_TRACE(noise);
    make({"torus", "--rows", "40", "--noise", noise});
    const Words torus{"--torus", "1,0.7071067811865476"};
    EXPECT_LT(smooth({"--denoise"}, torus)["error"].get<double>(),
              1.1 * smooth(umbrella_, torus)["error"].get<double>());
  }
}

TEST_F(DenoiseRoundShapes, AGivenLaplacianStays) {
  make({"icosphere", "--subdivide", "3", "--noise", "0.2"});
  for (const std::string laplacian : {"weighted", "crouzeix-raviart"}) {
    const nlohmann::json report =
        smooth({"--denoise", "--laplacian", laplacian}, {"--sphere", "1"});
    EXPECT_EQ(report["options"]["laplacian"], laplacian);
  }
}

}  // namespace
}  // namespace ibmfair::test
