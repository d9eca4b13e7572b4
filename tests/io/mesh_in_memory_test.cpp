// A mesh from memory is read as a file would be, and files take values and positions from memory.
#include "ibmfair/io/mesh_in_memory.h"

#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"

namespace ibmfair::test {
namespace {

Mesh house() {
  Mesh mesh;
  mesh.X.resize(5, 3);
  mesh.X << 0, 0, 1e-300, 1, 0, 0.1, 1, 1, 1.0 / 3, 0, 1, -1e300, 0.5, 1.5, 5e-324;
  mesh.faces.add(std::vector<Index>{0, 1, 2, 3});
  mesh.faces.add(std::vector<Index>{3, 2, 4});
  return mesh;
}

MeshFile file_of(const Mesh& mesh) {
  return mesh_in_memory("the mesh", {{mesh.X.data(), static_cast<std::size_t>(mesh.X.size())},
                                     mesh.faces.first,
                                     mesh.faces.corner});
}

TEST(MeshInMemory, KeepsNumbersAndPolygons) {
  const Mesh mesh = house();
  const MeshFile file = file_of(mesh);
  EXPECT_EQ(file.name(), "the mesh");
  EXPECT_TRUE(file.mesh().X == mesh.X);
  EXPECT_EQ(file.mesh().faces.first, mesh.faces.first);
  EXPECT_EQ(file.mesh().faces.corner, mesh.faces.corner);
}

TEST(MeshInMemory, RefusesCornersThatAreNoVertices) {
  Mesh mesh = house();
  mesh.faces.corner.back() = 5;
  EXPECT_THROW(file_of(mesh), BadFile);
}

TEST(MeshInMemory, FilesTakeValuesFromMemory) {
  const std::vector<double> a{0, 1, 0, 2, 0}, b{0.1, -1, 1e-300, 7, 3};
  const MeshFile plain = file_of(house()), file = plain.with_values("a", a).with_values("x", b);
  EXPECT_FALSE(plain.vertex_values("a"));
  EXPECT_EQ(*file.vertex_values("a"), a);
  EXPECT_EQ(file.vertex_mask("a"), (std::vector<std::uint8_t>{0, 1, 0, 1, 0}));
  EXPECT_EQ(*file.vertex_values("x"), b);  // before the coordinate in the bytes
  EXPECT_EQ(*file.with_values("a", b).vertex_values("a"), b);
}

TEST(MeshInMemory, FilesTakePositionsFromMemory) {
  const MeshFile file = file_of(house());
  const Points X = 2 * file.mesh().X.cwiseMin(1.0).cwiseMax(-1.0);
  const MeshFile moved = file.with_positions(X);
  EXPECT_TRUE(moved.mesh().X == X);
  EXPECT_TRUE(file.mesh().X == house().X);
}

TEST(MeshInMemory, MergedVerticesAreToldByTheFile) {
  Points X = house().X;
  X.row(4) = X.row(0);
  const MeshFile file =
      file_of(house()).with_positions(X).with_values("a", {1, 2, 3, 4, 5}).merged_exactly();
  EXPECT_TRUE(file_of(house()).merged_vertices().empty());
  EXPECT_EQ(file.merged_vertices(), (std::vector<Index>{0, 1, 2, 3, 0}));
  EXPECT_EQ(*file.vertex_values("a"), (std::vector<double>{1, 2, 3, 4}));
  EXPECT_FALSE(file_of(house()).merged_exactly().welded());
}

}  // namespace
}  // namespace ibmfair::test
