// Runs `smooth` on several ranks, beside the single process.
#pragma once

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "ibmfair/base/types.h"
#include "ibmfair/mesh/mesh.h"
#include "support/run_program.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {

/// What became of a mesh.
struct Fair {
  RunResult run;
  std::string bytes;  ///< of the output; empty where there is none, which fails the test
  nlohmann::json report;

  Points X() const;  ///< of the output, which must be PLY
};

class RanksTest : public testing::Test {
 protected:
  /// Writes the mesh as a binary PLY file and returns its name.
  std::string file_of(const Mesh& mesh, const std::string& name = "in.ply") const;

  /// One process that solves as exactly as it can.
  Fair on_one(const std::string& input, const Words& options,
              const std::string& output = "one.ply") const;

  /// `count` ranks that do so; `petsc` are PETSc's own options.
  Fair on_ranks(int count, const std::string& input, const Words& options, const Words& petsc = {},
                const std::string& output = "ranks.ply") const;

  /// Any arguments, on `count` ranks.
  RunResult run_on_ranks(int count, const Words& arguments, RunOptions options = {}) const;

  /// Fewer cores than ranks are no mistake in a test, nor is a container's root. Open MPI keeps the
  /// files of its runs in one directory of the user, which a run that ends removes under one that
  /// begins: each test has its own.
  Words mpi_environment() const;

  TemporaryDirectory files_;

 private:
  Fair collect(RunResult run, const std::string& output) const;

  TemporaryDirectory sessions_;
};

/// The largest difference of two states over the size of the first.
double relative_difference(const Points& X, const Points& Y);

}  // namespace ibmfair::test
