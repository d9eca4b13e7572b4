// Odd and hostile files that others collected: files with a meaning are read, all other files are
// refused with a message, and every mesh that is read can be written again.
#include <filesystem>

#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/io/formats.h"
#include "ibmfair/io/source_bytes.h"
#include "support/files.h"
#include "support/malformed_outcomes.h"
#include "support/mesh_io.h"

namespace ibmfair::test {
namespace {

/// Whether the table of outcomes says that the program reads this file.
bool is_readable(const Outcomes& outcomes, const std::string& name) {
  constexpr int bad_file = 3;
  const auto row = outcomes.find(name);
  if (row == outcomes.end()) {
    ADD_FAILURE() << "the table has no such file";
    return false;
  }
  return row->second.at("info").exit_code != bad_file;
}

TEST(MalformedFiles, AreReadOrRefused) {
  const std::vector<std::string> paths = shared_meshes("malformed");
  if (paths.empty()) GTEST_SKIP() << "no ../shared/meshes";
  const Outcomes outcomes = expected_outcomes();
  MeshFiles files;
  for (const std::string& path : paths) {
    const std::filesystem::path full(path);
    const std::string name = full.parent_path().filename() / full.filename();
    SCOPED_TRACE(name);
    const bool readable = is_readable(outcomes, name);
    try {
      const MeshFile file = read_mesh(path);
      EXPECT_TRUE(readable);
      EXPECT_EQ(triangulate(file.mesh()).F.rows(),
                static_cast<Eigen::Index>(file.mesh().faces.corner.size()) -
                    2 * static_cast<Eigen::Index>(file.mesh().faces.size()));
      if (file.format().patch == nullptr) continue;
      const std::string copy = "copy." + std::string(file.format().name);
      EXPECT_EQ(files.write(file, file.mesh().X, copy), file.bytes().view());
      const Points Y = mostly_moved(file.mesh().X);
      files.write(file, Y, copy);
      const Mesh again = read_mesh(files.path(copy)).mesh();
      const bool binary_off = name.starts_with("off/binary");
      EXPECT_LE((again.X - Y).cwiseAbs().maxCoeff(),
                binary_off ? 1e-6 * Y.cwiseAbs().maxCoeff() : 0.0);
      EXPECT_EQ(again.faces.corner, file.mesh().faces.corner);
    } catch (const BadFile& error) {
      EXPECT_FALSE(readable) << error.what();
      EXPECT_TRUE(std::string(error.what()).starts_with(path + ":")) << error.what();
    }
  }
}

TEST(RealFiles, AreCarried) {
  int count = 0;
  MeshFiles files;
  for (const std::string folder : {"models", "holes"}) {
    for (const std::string& path : shared_meshes(folder)) {
      if (std::filesystem::file_size(path) > 3000000) continue;
      SCOPED_TRACE(path);
      const MeshFile file = read_mesh(path);
      const std::string copy = "copy." + std::string(file.format().name);
      EXPECT_EQ(files.write(file, file.mesh().X, copy), file.bytes().view());
      ++count;
    }
  }
  if (count == 0) GTEST_SKIP() << "no ../shared/meshes";
}

}  // namespace
}  // namespace ibmfair::test
