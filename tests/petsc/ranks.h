// Runs `smooth` on several ranks, and on a single process for comparison.
#pragma once

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "ibmfair/base/types.h"
#include "ibmfair/mesh/mesh.h"
#include "support/run_program.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {

/// The result of smoothing a mesh.
struct Fair {
  RunResult run;
  std::string bytes;  ///< of the output; empty if there is none, which fails the test
  nlohmann::json report;

  Points X() const;  ///< of the output, which must be PLY
};

class RanksTest : public testing::Test {
 protected:
  /// Writes the mesh as a binary PLY file and returns its name.
  std::string file_of(const Mesh& mesh, const std::string& name = "in.ply") const;

  /// Runs one process that solves as exactly as it can.
  Fair on_one(const std::string& input, const Words& options,
              const std::string& output = "one.ply") const;

  /// Runs `count` ranks that solve as exactly as they can; `petsc` are PETSc's own options.
  Fair on_ranks(int count, const std::string& input, const Words& options, const Words& petsc = {},
                const std::string& output = "ranks.ply") const;

  /// Runs the program with any arguments on `count` ranks.
  RunResult run_on_ranks(int count, const Words& arguments, RunOptions options = {}) const;

  /// Variables for Open MPI. They allow fewer cores than ranks, and the root user of a container.
  /// Open MPI keeps the files of its runs in one directory of the user, and a run that ends may
  /// remove this directory under a run that begins: therefore each test has a directory of its own.
  Words mpi_environment() const;

  TemporaryDirectory files_;

 private:
  Fair collect(RunResult run, const std::string& output) const;

  TemporaryDirectory sessions_;
};

/// The largest difference between two states, divided by the size of the first state.
double relative_difference(const Points& X, const Points& Y);

}  // namespace ibmfair::test
