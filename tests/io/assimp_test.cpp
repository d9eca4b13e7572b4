// Formats that are read through assimp: the program reads them, never writes them, and reports that
// their coordinates are float32.
#include <cstdlib>

#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/io/formats.h"
#include "support/files.h"
#include "support/foreign_meshes.h"
#include "support/mesh_io.h"

namespace ibmfair::test {
namespace {

/// Two triangles of a square; each facet has its own corners, as in every STL file.
constexpr std::string_view square_stl =
    "solid square\n"
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\n"
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\n"
    "endsolid square\n";

bool mentions(const std::vector<std::string>& notes, const std::string& text) {
  for (const std::string& note : notes) {
    if (note.find(text) != std::string::npos) return true;
  }
  return false;
}

TEST(AssimpFile, WeldsStlExactly) {
  const TemporaryDirectory directory;
  write_bytes(directory / "a.stl", square_stl);
  const MeshFile file = read_mesh(directory / "a.stl");
  EXPECT_EQ(file.format().name, "stl");
  EXPECT_EQ(file.mesh().X.rows(), 4);
  EXPECT_EQ(file.mesh().faces.size(), 2);
  EXPECT_FALSE(file.has_normals());
  EXPECT_TRUE(mentions(file.notes(), "float32"));
  EXPECT_TRUE(mentions(file.notes(), "merged 2 vertices"));
  const WriteReport report = write_mesh(file, file.mesh().X, directory / "b.ply");
  EXPECT_FALSE(report.patched);
  EXPECT_EQ(read_mesh(directory / "b.ply").mesh().X, file.mesh().X);
}

TEST(AssimpFile, ReadsFromMemory) {
  const MeshFile file = MeshFiles::read(square_stl, "standard input", {.format = "stl"});
  EXPECT_EQ(file.mesh().X.rows(), 4);
}

TEST(AssimpFile, ReadsEveryForeignFormatFromFileAndMemory) {
  const TemporaryDirectory directory;
  for (const auto& [extension, bytes] : foreign_triangles()) {
    SCOPED_TRACE(extension);
    const std::string path = directory / ("triangle." + extension);
    write_bytes(path, bytes);
    const Points X = read_mesh(path).mesh().X;
    EXPECT_EQ(X.rows(), 3);
    EXPECT_EQ(MeshFiles::read(bytes, "standard input", {.format = extension}).mesh().X, X);
    if (extension == "glb") {
      EXPECT_EQ(MeshFiles::read(bytes, "standard input").mesh().X, X);  // known by its first bytes
    }
  }
}

TEST(AssimpFile, ReadsAFileWhoseNameDoesNotTellTheFormat) {
  const TemporaryDirectory directory;
  write_bytes(directory / "square.dat", square_stl);
  EXPECT_EQ(read_mesh(directory / "square.dat", {.format = "stl"}).mesh().X.rows(), 4);
}

TEST(AssimpFile, AppliesNodeTransforms) {
  if (!imports_can_refer_to_files()) GTEST_SKIP() << "no openat2";
  const TemporaryDirectory directory;
  // One triangle is shown by two nodes. The second node is a child that doubles and shifts the
  // triangle.
  write_bytes(directory / "a.gltf", R"({"asset":{"version":"2.0"},"scene":0,
    "scenes":[{"nodes":[0]}],
    "nodes":[{"mesh":0,"translation":[10,0,0],"children":[1]},
             {"mesh":0,"scale":[2,2,2],"translation":[0,0,5]}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",
                  "min":[0,0,0],"max":[1,1,0]}],
    "bufferViews":[{"buffer":0,"byteLength":36}],
    "buffers":[{"byteLength":36,"uri":"a.bin"}]})");
  std::string buffer;
  for (const double x : {0, 0, 0, 1, 0, 0, 0, 1, 0})
    buffer += to_bytes(x, 4, false, true);
  write_bytes(directory / "a.bin", buffer);
  const MeshFile file = read_mesh(directory / "a.gltf");
  Points expected(6, 3);
  expected << 10, 0, 0, 11, 0, 0, 10, 1, 0, 10, 0, 5, 12, 0, 5, 10, 2, 5;
  EXPECT_EQ(file.mesh().X, expected);
  EXPECT_EQ(file.mesh().faces.corner, (std::vector<Index>{0, 1, 2, 3, 4, 5}));
  EXPECT_FALSE(file.welded());
}

TEST(AssimpFile, RefusesWhatAssimpRefuses) {
  for (const std::string name : {"a.stl", "a.glb", "a.3ds", "a.dae", "a.fbx", "a.lwo"}) {
    EXPECT_NE(read_error("neither this nor that", name), "") << name;
  }
  EXPECT_NE(read_error("solid nothing\nendsolid nothing\n", "a.stl"), "");
}

}  // namespace
}  // namespace ibmfair::test
