// A mesh from memory is read as a file would be: every number, polygon and property is there.
#include "ibmfair/io/mesh_in_memory.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/io/formats.h"

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

TEST(MeshInMemory, KeepsNumbersPolygonsAndProperties) {
  const Mesh mesh = house();
  const std::vector<double> a{0, 1, 0, 2, 0}, b{0.1, -1, 1e-300, 7, 3};
  const std::vector<VertexProperty> properties{{"@a", a}, {"b", b}};
  for (const bool with : {false, true}) {
    const MeshFile file = mesh_in_memory("the mesh", MeshView(mesh),
                                         with ? properties : std::vector<VertexProperty>());
    EXPECT_EQ(file.name(), "the mesh");
    EXPECT_TRUE(file.mesh().X == mesh.X);
    EXPECT_EQ(file.mesh().faces.first, mesh.faces.first);
    EXPECT_EQ(file.mesh().faces.corner, mesh.faces.corner);
    EXPECT_EQ(file.vertex_values("b").has_value(), with);
    if (with) {
      EXPECT_EQ(*file.vertex_values("b"), b);
      EXPECT_EQ(file.vertex_mask("@a"), (std::vector<std::uint8_t>{0, 1, 0, 1, 0}));
    }
  }
}

TEST(MeshInMemory, RefusesCornersThatAreNoVertices) {
  Mesh mesh = house();
  mesh.faces.corner.back() = 5;
  EXPECT_THROW(mesh_in_memory("the mesh", MeshView(mesh)), BadFile);
}

TEST(MeshInMemory, MergedVerticesAreToldByTheFile) {
  Mesh mesh = house();
  mesh.X.row(4) = mesh.X.row(0);
  const MeshFile file = mesh_in_memory("the mesh", MeshView(mesh));
  EXPECT_TRUE(file.merged_vertices().empty());
  const CloseWeld weld(file, 0);
  EXPECT_EQ(weld.file.merged_vertices(), (std::vector<Index>{0, 1, 2, 3, 0}));
}

}  // namespace
}  // namespace ibmfair::test
