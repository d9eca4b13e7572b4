// Odd, broken and hostile files: files with a meaning are read, all other files are refused with a
// message, and every mesh that is read can be written again.
#include <filesystem>

#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/io/formats.h"
#include "ibmfair/io/source_bytes.h"
#include "support/files.h"
#include "support/malformed_files.h"
#include "support/mesh_io.h"

namespace ibmfair::test {
namespace {

/// Checks that the file is read or refused; `outcome` is that of the command that only reads.
/// A file that is read, and that can be patched, must be carried: with no vertex moved it is
/// written byte by byte, and moved vertices are read back from it.
void expect_read_or_refused(const std::string& path, const Outcome& outcome) {
  constexpr int bad_file = 3;
  const bool readable = outcome.exit_code != bad_file;
  MeshFiles files;
  try {
    const MeshFile file = read_mesh(path);
    EXPECT_TRUE(readable);
    EXPECT_EQ(triangulate(file.mesh()).F.rows(),
              static_cast<Eigen::Index>(file.mesh().faces.corner.size()) -
                  2 * static_cast<Eigen::Index>(file.mesh().faces.size()));
    if (file.format().patch == nullptr) return;
    const std::string copy = "copy." + std::string(file.format().name);
    EXPECT_EQ(files.write(file, file.mesh().X, copy), file.bytes().view());
    const Points Y = mostly_moved(file.mesh().X);
    files.write(file, Y, copy, {.precision = WriteOptions::Precision::float64});
    const Mesh again = read_mesh(files.path(copy)).mesh();
    const bool binary_off = file.format().name == "off" && contains(path, "binary");
    EXPECT_LE((again.X - Y).cwiseAbs().maxCoeff(),
              binary_off ? 1e-6 * Y.cwiseAbs().maxCoeff() : 0.0);
    EXPECT_EQ(again.faces.corner, file.mesh().faces.corner);
  } catch (const BadFile& error) {
    EXPECT_FALSE(readable) << error.what();
    EXPECT_TRUE(std::string(error.what()).starts_with(path + ":")) << error.what();
  }
}

TEST(MalformedFiles, AreReadOrRefused) {
  const TemporaryDirectory directory;
  for (const std::string format : {"obj", "off", "ply", "stl"}) {
    for (const MalformedFile& file : malformed_files(format)) {
      SCOPED_TRACE(file.name);
      write_bytes(directory / file.name, file.bytes);
      expect_read_or_refused(directory / file.name, file.outcomes.at("info"));
    }
  }
}

TEST(SharedMalformedFiles, AreReadOrRefused) {
  const std::vector<std::string> paths = shared_meshes("malformed");
  if (paths.empty()) GTEST_SKIP() << "no ../shared/meshes";
  const Outcomes outcomes = expected_outcomes();
  for (const std::string& path : paths) {
    const std::filesystem::path full(path);
    const std::string name = full.parent_path().filename() / full.filename();
    SCOPED_TRACE(name);
    ASSERT_TRUE(outcomes.contains(name)) << "the table has no such file";
    expect_read_or_refused(path, outcomes.at(name).at("info"));
  }
}

/// Checks that the file is written byte by byte with no vertex moved.
void expect_same_bytes(const std::string& path) {
  SCOPED_TRACE(path);
  MeshFiles files;
  const MeshFile file = read_mesh(path);
  EXPECT_EQ(files.write(file, file.mesh().X, "copy." + std::string(file.format().name)),
            file.bytes().view());
}

TEST(RealFiles, AreCarried) {
  for (const std::string& path : project_meshes()) {
    expect_same_bytes(path);
  }
}

TEST(SharedFiles, AreCarried) {
  const std::vector<std::string> paths = shared_meshes_below(3'000'000);
  if (paths.empty()) GTEST_SKIP() << "no ../shared/meshes";
  for (const std::string& path : paths) {
    expect_same_bytes(path);
  }
}

}  // namespace
}  // namespace ibmfair::test
