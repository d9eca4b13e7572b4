// Odd and hostile files that others collected: read where they mean something, else refused in
// words, and whatever is read can be written again.
#include <filesystem>
#include <set>

#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/io/formats.h"
#include "ibmfair/io/source_bytes.h"
#include "support/files.h"
#include "support/mesh_io.h"

namespace ibmfair::test {
namespace {

/// The files that hold no mesh; every other one must be read.
const std::set<std::string> without_mesh{"obj/afl_00.obj",
                                         "obj/afl_02.obj",
                                         "obj/afl_04.obj",
                                         "obj/afl_06.obj",
                                         "obj/afl_08.obj",
                                         "obj/afl_10.obj",
                                         "obj/bare_f_line.obj",
                                         "obj/clusterfuzz_huge_exponent_nul.obj",
                                         "obj/empty_0bytes.obj",
                                         "obj/empty_with_comment.obj",
                                         "obj/inf_nan.obj",
                                         "obj/lines_only.obj",
                                         "obj/notenoughindices.obj",
                                         "obj/point_cloud.obj",
                                         "obj/relative_texture_index_no_vertices.obj",
                                         "obj/utf16be.obj",
                                         "obj/w_component.obj",
                                         "obj/windows_coff_object.obj",
                                         "off/4OFF_hypercube.off",
                                         "off/embedded_in_geomview_object.off",
                                         "off/huge_vertex_count.off",
                                         "ply/crash_truncated_header_nul.ply",
                                         "ply/crlf_points.ply",
                                         "ply/empty_elements_ascii.ply",
                                         "ply/empty_header_only.ply",
                                         "ply/inf_points.ply",
                                         "ply/payload_JVN42386607.ply",
                                         "ply/points_only_70k.ply",
                                         "ply/points_with_lists.ply",
                                         "stl/empty_ascii.stl"};

TEST(MalformedFiles, AreReadOrRefused) {
  const std::vector<std::string> paths = shared_meshes("malformed");
  if (paths.empty()) GTEST_SKIP() << "no ../shared/meshes";
  MeshFiles files;
  for (const std::string& path : paths) {
    const std::filesystem::path full(path);
    const std::string name = full.parent_path().filename() / full.filename();
    SCOPED_TRACE(name);
    try {
      const MeshFile file = read_mesh(path);
      EXPECT_FALSE(without_mesh.contains(name));
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
      EXPECT_TRUE(without_mesh.contains(name)) << error.what();
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
