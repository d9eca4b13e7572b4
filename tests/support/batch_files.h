// A folder of meshes in which tests run batches.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/run_program.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {

/// The status of each item of a batch, by the item's input, or by its output if the item has no
/// input.
using Statuses = std::map<std::string, std::string>;

/// A folder that holds the meshes `in/a.off`, `in/b.off` and `in/c.off` of 162 vertices each. The
/// program is run in this folder.
class BatchTest : public testing::Test {
 protected:
  BatchTest();

  static std::string path(const std::string& name) { return "in/" + name + ".off"; }
  std::string full(const std::string& name) const { return directory_ / name; }
  bool exists(const std::string& name) const;
  std::string bytes(const std::string& name) const;

  RunResult run(const Words& arguments, RunOptions options = {}) const;

  /// Makes or replaces a mesh of the folder `in`: a sphere with noise.
  void make(const std::string& name, int seed, int subdivide = 2) const;

  /// The output of `ibmfair smooth` for one input that is run alone.
  std::string single(const std::string& input, const Words& options) const;

  /// Runs a batch, which must end with this exit code, and returns the status of each item.
  Statuses statuses(const Words& arguments, int exit_code = 0) const;

  /// The number of files with this extension in a folder; 0 if there is no such folder.
  std::size_t count(const std::string& folder, const std::string& extension = ".off") const;

  TemporaryDirectory directory_;
  Words inputs_;                                          ///< the three meshes
  const Words options_{"--steps", "2", "--cutoff", "4"};  ///< options of a short run
};

}  // namespace ibmfair::test
