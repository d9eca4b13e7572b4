// A folder of meshes to run batches in.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/run_program.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {

/// What became of the items of a batch, by input, or by output where an item has no input.
using Statuses = std::map<std::string, std::string>;

/// Holds meshes `in/a.off`, `in/b.off` and `in/c.off` of 162 vertices; the program is run there.
class BatchTest : public testing::Test {
 protected:
  BatchTest();

  static std::string path(const std::string& name) { return "in/" + name + ".off"; }
  std::string full(const std::string& name) const { return directory_ / name; }
  bool exists(const std::string& name) const;
  std::string bytes(const std::string& name) const;

  RunResult run(const Words& arguments, RunOptions options = {}) const;

  /// Makes or replaces a mesh of that folder: a sphere with noise.
  void make(const std::string& name, int seed, int subdivide = 2) const;

  /// What `ibmfair smooth` makes of one input when it is run alone.
  std::string single(const std::string& input, const Words& options) const;

  /// Runs a batch, which must end with this code.
  Statuses statuses(const Words& arguments, int exit_code = 0) const;

  /// How many files of this extension a folder holds; none where there is no such folder.
  std::size_t count(const std::string& folder, const std::string& extension = ".off") const;

  TemporaryDirectory directory_;
  Words inputs_;                                          ///< the three
  const Words options_{"--steps", "2", "--cutoff", "4"};  ///< a short run
};

}  // namespace ibmfair::test
