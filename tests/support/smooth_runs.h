// Runs of `smooth` on made shapes, through the real program.
#pragma once

#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "ibmfair/io/mesh_file.h"
#include "support/run_program.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {

/// A smoothed mesh with its report.
struct Smoothed {
  int exit_code = 0;
  std::string err;
  nlohmann::json report;
  Points X;
};

class SmoothRuns : public testing::Test {
 protected:
  Smoothed smooth(const std::string& input, const Words& options) {
    const RunResult run =
        run_program(Words{"smooth", input, files_ / "out.ply", "--overwrite", "--json"} + options);
    Smoothed result{run.exit_code, run.err, nlohmann::json::parse(run.out, nullptr, false), {}};
    if (run.exit_code == 0) {
      result.X = read_mesh(files_ / "out.ply").mesh().X;
    }
    return result;
  }

  std::string noisy(const std::string& shape, const Words& options) {
    std::string path = files_ / (shape + ".ply");
    const RunResult run = run_program(Words{"make", shape, path, "--overwrite"} + options);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return path;
  }

  TemporaryDirectory files_;
};

/// The blunting of the twelve edges of a cube (-1 to 1): the mean distance of the vertices that
/// were on an edge from this edge.
inline double edge_error(const Points& X, const Points& clean) {
  double sum = 0;
  int count = 0;
  for (Index v = 0; v < X.rows(); ++v) {
    const auto is_face = (clean.row(v).array().abs() - clean.cwiseAbs().maxCoeff()).abs() < 1e-9;
    if (is_face.count() < 2) {
      continue;
    }
    for (int axis = 0; axis < 3; ++axis) {
      sum += is_face[axis] ? std::abs(X(v, axis) - clean(v, axis)) : 0;
    }
    ++count;
  }
  return sum / count;
}

}  // namespace ibmfair::test
