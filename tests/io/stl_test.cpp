// STL output: the triangles of any mesh, in order, with float32 corners and unit normals.
#include "ibmfair/io/stl.h"

#include <cstring>
#include <string>

#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/mesh/mesh.h"
#include "support/files.h"
#include "support/mesh_io.h"
#include "support/meshes.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {
namespace {

/// The normal and the three corners of a triangle of a binary STL, one row each.
Eigen::Matrix<float, 4, 3, Eigen::RowMajor> triangle_at(const std::string& stl, Eigen::Index t) {
  Eigen::Matrix<float, 4, 3, Eigen::RowMajor> triangle;
  std::memcpy(triangle.data(), stl.data() + 84 + 50 * t, 48);
  return triangle;
}

TEST(Stl, HoldsTheTrianglesOfEveryMesh) {
  const TemporaryDirectory directory;
  for (const NamedMesh& named : at_all_scales(all_meshes())) {
    SCOPED_TRACE(named.name);
    const std::string path = directory / "a.stl";
    write_mesh(named.mesh, path, {.overwrite = true});
    const std::string stl = read_bytes(path);
    const Triangles F = triangulate(named.mesh).F;
    ASSERT_EQ(stl.size(), 84U + 50U * F.rows());
    EXPECT_FALSE(stl.starts_with("solid"));
    std::uint32_t count = 0;
    std::memcpy(&count, stl.data() + 80, 4);
    EXPECT_EQ(count, F.rows());
    for (Eigen::Index t = 0; t < F.rows(); ++t) {
      const auto triangle = triangle_at(stl, t);
      Eigen::Matrix3d x;
      for (int i = 0; i < 3; ++i) {
        x.row(i) = named.mesh.X.row(F(t, i));
        EXPECT_EQ(triangle.row(i + 1), x.row(i).cast<float>());
      }
      const Vec3 normal = triangle.row(0).cast<double>();
      const Vec3 e1 = (x.row(1) - x.row(0)).normalized(), e2 = (x.row(2) - x.row(0)).normalized();
      const double sine = e1.cross(e2).norm();
      if (sine > 1e-6) {
        EXPECT_NEAR(normal.norm(), 1, 1e-6);
        EXPECT_NEAR(normal.dot(e1.cross(e2)) / sine, 1, 1e-6);
      }
    }
  }
}

TEST(Stl, IsReadBackAndCopiedWhereNothingMoves) {
  const TemporaryDirectory directory;
  for (const NamedMesh& named : closed_meshes()) {
    SCOPED_TRACE(named.name);
    const std::string path = directory / "a.stl", copy = directory / "b.stl";
    write_mesh(named.mesh, path, {.overwrite = true});
    const MeshFile file = read_mesh(path);
    EXPECT_EQ(file.mesh().faces.size(), triangulate(named.mesh).F.rows());
    EXPECT_EQ(write_mesh(file, file.mesh().X, copy, {.overwrite = true}).moved_vertices, 0);
    EXPECT_EQ(read_bytes(copy), read_bytes(path));
    Points Y = file.mesh().X;
    Y.row(0) += Vec3(0.25, 0, 0);
    EXPECT_EQ(write_mesh(file, Y, copy, {.overwrite = true}).moved_vertices, 1);
    EXPECT_EQ(read_bytes(copy).size(), read_bytes(path).size());
    EXPECT_NE(read_bytes(copy), read_bytes(path));
  }
}

TEST(Stl, RefusesWhatFloat32CannotHold) {
  const TemporaryDirectory directory;
  const Mesh mesh = moved(flat_sheet(3, 3), 1e39, Vec3::Zero());
  EXPECT_THROW(write_mesh(mesh, directory / "a.stl"), BadMesh);
  EXPECT_EQ(directory.entries(), 0U);
}

}  // namespace
}  // namespace ibmfair::test
