// Reading and writing small mesh files whose whole text is given in the test.
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

  /// Writes the mesh with its vertices at X and with an extension.
  std::string write(const MeshFile& file, const Points& X, const Extension& extension,
                    const std::string& name, WriteOptions options = {},
                    WriteReport* report = nullptr);

  std::string path(const std::string& name) const { return directory_ / name; }
  std::size_t entries() const { return directory_.entries(); }

 private:
  TemporaryDirectory directory_;
};

/// The message of the BadFile that must be thrown when the bytes are read as a file called `name`.
/// If reading does not throw, the message is empty and an expectation fails.
std::string read_error(std::string_view bytes, const std::string& name);

/// The law of every file that can be patched. A file that is written back with unmoved vertices has
/// the same bytes. A file that is written with two thirds of its vertices moved, in double, and
/// read again, has exactly these positions and the same faces. If the vertices are then moved back,
/// the file has its first positions again. Returns the file as first read.
MeshFile expect_carried(std::string_view bytes, const std::string& name);

/// The points X with two thirds of the vertices moved by a few per cent of their coordinates.
Points mostly_moved(const Points& X);

/// The lines of a text that differ from those of another text with as many lines; only -1 if the
/// numbers of lines differ.
std::vector<int> different_lines(std::string_view a, std::string_view b);

/// The text with every `what` replaced.
std::string replaced(std::string text, const std::string& what, const std::string& by);

/// The bytes that a binary file has for a number.
std::string to_bytes(double value, int size, bool big_endian, bool real);

}  // namespace ibmfair::test
