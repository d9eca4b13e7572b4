// Truncated STL files: no part of a mesh passes for the whole, and the message counts triangles.
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "ibmfair/mesh/mesh.h"
#include "support/files.h"
#include "support/mesh_io.h"
#include "support/meshes.h"

namespace ibmfair::test {
namespace {

constexpr std::size_t header = 84, row = 50;

std::string binary_stl(const Mesh& mesh) {
  const TemporaryDirectory directory;
  write_mesh(mesh, directory / "a.stl");
  return read_bytes(directory / "a.stl");
}

/// The mesh as ASCII STL without `endsolid`, each token of which ends with this text.
std::string ascii_stl(const Mesh& mesh, const std::string& name, const std::string& end = "\n") {
  std::string text = "solid " + name + "\n";
  const Triangles F = triangulate(mesh).F;
  for (Eigen::Index t = 0; t < F.rows(); ++t) {
    text.append("facet normal 0 0 0").append(end).append("outer loop").append(end);
    for (const Index v : F.row(t)) {
      text += fmt::format("vertex {} {} {}{}", mesh.X(v, 0), mesh.X(v, 1), mesh.X(v, 2), end);
    }
    text.append("endloop").append(end).append("endfacet").append(end);
  }
  return text;
}

TEST(StlReading, CallsABinaryFileTruncatedWhereverItEnds) {
  for (const NamedMesh& named : closed_meshes()) {
    SCOPED_TRACE(named.name);
    const std::string whole = binary_stl(named.mesh);
    const std::size_t triangles = (whole.size() - header) / row;
    for (std::size_t size = header; size < whole.size(); size += 37) {
      const std::string message = read_error(whole.substr(0, size), "a.stl");
      EXPECT_NE(
          message.find(fmt::format("truncated (or no STL): of the {} triangles that its header "
                                   "announces, {} are there",
                                   triangles, (size - header) / row)),
          std::string::npos)
          << message;
    }
    for (std::size_t size = 0; size < header; size += 7) {
      EXPECT_NE(read_error(whole.substr(0, size), "a.stl"), "");
    }
  }
}

TEST(StlReading, CallsATextTruncatedWhereverItEndsWithinATriangle) {
  const Mesh mesh = barrel(5);
  const auto triangles = static_cast<std::size_t>(triangulate(mesh).F.rows());
  const std::string text = ascii_stl(mesh, "barrel");
  for (std::size_t size = text.find("facet") + 5; size < text.size(); size += 11) {
    const std::string part = text.substr(0, size);
    std::size_t complete = 0;
    for (std::size_t at = part.find("endfacet"); at != std::string::npos;
         at = part.find("endfacet", at + 1)) {
      ++complete;
    }
    const std::size_t last_facet = part.rfind("\nfacet");
    const std::size_t last_end = part.rfind("endfacet");
    if (last_end != std::string::npos && last_end > last_facet) continue;
    const std::string message = read_error(part, "a.stl");
    EXPECT_NE(message.find("the file is truncated"), std::string::npos) << message;
    EXPECT_NE(message.find(fmt::format("after {} complete", complete)), std::string::npos)
        << message;
  }
  // All triangles, but no end: read, with a warning.
  const MeshFile file = MeshFiles::read(text, "a.stl");
  EXPECT_EQ(file.mesh().faces.size(), static_cast<Index>(triangles));
  ASSERT_EQ(file.warnings().size(), 1U);
  EXPECT_NE(file.warnings()[0].find("a.stl: "), std::string::npos);
  EXPECT_NE(file.warnings()[0].find("endsolid"), std::string::npos);
}

TEST(StlReading, TakesWholeFilesWithoutAWord) {
  const Mesh mesh = barrel(5);
  const auto triangles = static_cast<Index>(triangulate(mesh).F.rows());
  for (const std::string name : {"barrel", "", "facet of a solid", "W\xC3\xBCrfel", "endfacet"}) {
    for (const std::string end : {"\n", "\r\n", " \n\t"}) {
      SCOPED_TRACE(name);
      const MeshFile file =
          MeshFiles::read(ascii_stl(mesh, name, end) + "endsolid " + name + "\n", "a.stl");
      EXPECT_EQ(file.mesh().faces.size(), triangles);
      EXPECT_TRUE(file.warnings().empty());
    }
  }
  EXPECT_TRUE(MeshFiles::read(binary_stl(mesh), "a.stl").warnings().empty());
}

TEST(StlReading, LeavesOutBytesBehindTheLastTriangle) {
  const Mesh mesh = barrel(5);
  const std::string whole = binary_stl(mesh);
  const MeshFile file = MeshFiles::read(whole + std::string(77, 'x'), "a.stl");
  EXPECT_EQ(file.mesh().X, MeshFiles::read(whole, "a.stl").mesh().X);
  ASSERT_EQ(file.warnings().size(), 1U);
  EXPECT_NE(file.warnings()[0].find("77 bytes"), std::string::npos);
}

TEST(StlReading, TakesABinaryFileWhoseHeaderStartsWithSolid) {
  std::string bytes = binary_stl(barrel(5));
  bytes.replace(0, 20, "solid made elsewhere");
  EXPECT_EQ(MeshFiles::read(bytes, "a.stl").mesh().faces.size(), 20);
  EXPECT_NE(read_error(bytes.substr(0, 500), "a.stl").find("truncated"), std::string::npos);
}

}  // namespace
}  // namespace ibmfair::test
