// Reading and writing small mesh files whose whole text stands in the test.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ibmfair/io/extension.h"
#include "ibmfair/io/mesh_file.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {

/// A directory for the files of one test.
class MeshFiles {
 public:
  /// Reads the bytes as a mesh file called `name`.
  static MeshFile read(std::string_view bytes, const std::string& name, ReadOptions options = {});

  /// Writes the mesh with its vertices at X and returns the bytes. `report`, if given, receives the
  /// writer's report.
  std::string write(const MeshFile& file, const Points& X, const std::string& name,
                    WriteOptions options = {}, WriteReport* report = nullptr);

  /// The same with an extension.
  std::string write(const MeshFile& file, const Points& X, const Extension& extension,
                    const std::string& name, WriteOptions options = {},
                    WriteReport* report = nullptr);

  std::string path(const std::string& name) const { return directory_ / name; }
  std::size_t entries() const { return directory_.entries(); }

 private:
  TemporaryDirectory directory_;
};

/// The message of the BadFile that reading the bytes as a file called `name` must throw; empty (and
/// a failed expectation) where it throws none.
std::string read_error(std::string_view bytes, const std::string& name);

/// The law of every file that can be patched: written back with nothing moved it is the same bytes;
/// with two thirds of its vertices moved and read again it has exactly those positions and the same
/// faces; moved back after that it has the first positions again. Returns the file as first read.
MeshFile expect_carried(std::string_view bytes, const std::string& name);

/// Two thirds of the vertices moved by a few per cent of their coordinates.
Points mostly_moved(const Points& X);

/// The lines of a text that differ from those of another with as many lines; -1 alone where the
/// numbers of lines differ.
std::vector<int> different_lines(std::string_view a, std::string_view b);

/// The text with every `what` replaced.
std::string replaced(std::string text, const std::string& what, const std::string& by);

/// The bytes of a number as a binary file holds it.
std::string to_bytes(double value, int size, bool big_endian, bool real);

}  // namespace ibmfair::test
