// The laws of writing a mesh with an extension, over formats and classes of meshes.
#include <array>
#include <filesystem>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/io/formats.h"
#include "ibmfair/io/source_bytes.h"
#include "support/extensions.h"
#include "support/files.h"
#include "support/mesh_io.h"
#include "support/meshes.h"

namespace ibmfair::test {
namespace {

/// After writing and reading, the mesh is the source with the extension appended, bit for bit.
void expect_extended(const MeshFile& again, const Mesh& mesh, const Points& X,
                     const Extension& extension) {
  const Eigen::Index vertices = X.rows();
  ASSERT_EQ(again.mesh().X.rows(), vertices + extension.X.rows());
  EXPECT_EQ(again.mesh().X.topRows(vertices), X);
  EXPECT_EQ(again.mesh().X.bottomRows(extension.X.rows()), extension.X);
  Polygons faces = mesh.faces;
  for (Eigen::Index f = 0; f < extension.F.rows(); ++f)
    faces.add({extension.F.row(f).data(), 3});
  EXPECT_EQ(again.mesh().faces.first, faces.first);
  EXPECT_EQ(again.mesh().faces.corner, faces.corner);
}

/// The bytes of a mesh that comes from no file, in every format that can be written.
std::vector<std::pair<std::string, std::string>> as_files(const Mesh& mesh) {
  const TemporaryDirectory directory;
  std::vector<std::pair<std::string, std::string>> files;
  for (const Format& format : formats()) {
    if (format.patch == nullptr) continue;
    const std::string name = "a." + std::string(format.name);
    write_mesh(mesh, directory / name);
    files.emplace_back(name, read_bytes(directory / name));
  }
  return files;
}

TEST(Extension, IsReadBackBehindTheSourceForEveryMesh) {
  MeshFiles files;
  for (const NamedMesh& named : all_meshes()) {
    const Tents tents(named.mesh, some_faces(named.mesh, 7));
    ASSERT_GT(tents.extension.F.rows(), 0);
    const auto sources = as_files(named.mesh);
    for (const auto& [name, bytes] : sources) {
      const MeshFile file = MeshFiles::read(bytes, name);
      const Points& X = file.mesh().X;
      for (const auto& [target, unused] : sources) {
        SCOPED_TRACE(testing::PrintToString(std::array{named.name, name, target}));
        WriteReport report;
        files.write(file, X, tents.extension, target, {}, &report);
        EXPECT_EQ(report.patched, name == target);
        EXPECT_EQ(report.moved_vertices, 0);
        expect_extended(read_mesh(files.path(target)), file.mesh(), X, tents.extension);
      }
    }
  }
}

TEST(Extension, LeavesTheSourcesRowsAsTheyAre) {
  MeshFiles files;
  for (const NamedMesh& named : all_meshes()) {
    const Tents tents(named.mesh, some_faces(named.mesh, 5));
    for (const auto& [name, bytes] : as_files(named.mesh)) {
      SCOPED_TRACE(named.name + " " + name);
      const MeshFile file = MeshFiles::read(bytes, name);
      const std::string out = files.write(file, file.mesh().X, tents.extension, name);
      if (name == "a.obj") {
        EXPECT_EQ(out.substr(0, bytes.size()), bytes);
        continue;
      }
      // The rows of the vertices and the rows of the faces are each in one piece.
      const auto vertices = static_cast<std::size_t>(named.mesh.X.rows());
      std::size_t start = bytes.find("end_header\n") + 11;
      std::size_t faces = start + 24 * vertices;
      if (name == "a.off") {
        start = bytes.find('\n', bytes.find('\n') + 1) + 1;
        faces = start;
        for (std::size_t v = 0; v < vertices; ++v)
          faces = bytes.find('\n', faces) + 1;
      }
      const std::size_t first = out.find(bytes.substr(start, faces - start));
      const std::size_t second = out.find(bytes.substr(faces));
      EXPECT_NE(first, std::string::npos);
      EXPECT_NE(second, std::string::npos);
      EXPECT_GT(second, first);
    }
  }
}

TEST(Extension, WithNothingInItChangesNothing) {
  MeshFiles files;
  Extension nothing;
  nothing.extend = [](const Eigen::MatrixXd&) -> Eigen::MatrixXd {
    throw std::logic_error("call");
  };
  const Mesh mesh = flat_sheet(3, 2);
  for (const auto& [name, bytes] : as_files(mesh)) {
    const MeshFile file = MeshFiles::read(bytes, name);
    EXPECT_EQ(files.write(file, file.mesh().X, nothing, name), bytes);
    const Points Y = mostly_moved(file.mesh().X);
    EXPECT_EQ(files.write(file, Y, nothing, name), files.write(file, Y, name));
  }
}

/// Files of every format, with colours, normals and texture coordinates if the format can have
/// them.
const std::vector<std::pair<std::string, std::string>>& rich_files() {
  static const std::vector<std::pair<std::string, std::string>> files = {
      {"a.obj",
       "mtllib m\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nv 1 1 1 1 1 1\nvt 0 0\nvt 1 0\n"
       "vt 0 1\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\nvn -1 0 0\ng a\nf 1/1/1 2/2/2 3/3/3\n"
       "usemtl m\nf 4/1/4 3/3/3 2/2/2\n# end"},
      {"flat.obj",
       "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\nvn 0 0 1\nvn -1 0 0\n"
       "f 1//1 2//1 3//1\nf 4//2 3//2 2//2\n"},
      {"a.ply",
       "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
       "property double z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
       "property float nx\nproperty float ny\nproperty float nz\nproperty float quality\n"
       "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
       "0 0 0 255 0 0 0 0 1 0.5\n1 0 0 0 255 0 0 0 1 0\n0 1 0 0 0 255 0 0 1 0.25\n"
       "1 1 1 9 9 9 1 0 0 0.125\n3 0 1 2\n3 3 2 1\n"},
      {"a.off",
       "STCNOFF\n4 2 5\n0 0 0 0 0 1 9 9 9 9 .5 .5\n1 0 0 0 0 1 9 9 9 9 0 0\n"
       "0 1 0 0 0 1 9 9 9 9 1 1\n1 1 1 1 0 0 1 2 3 4 0 1\n3 0 1 2 7\n3 3 2 1\n"}};
  return files;
}

TEST(Extension, MovesTheRimAsWithoutOne) {
  MeshFiles files;
  for (const auto& [name, bytes] : rich_files()) {
    SCOPED_TRACE(name);
    const MeshFile file = MeshFiles::read(bytes, name);
    const Tents tents(file.mesh(), {1});
    const Points Y = mostly_moved(file.mesh().X);
    const std::string at_once = files.write(file, Y, tents.extension, "once-" + name);
    files.write(file, Y, "moved-" + name);
    const MeshFile moved = read_mesh(files.path("moved-" + name));
    EXPECT_EQ(at_once, files.write(moved, Y, tents.extension, "twice-" + name));
    expect_extended(read_mesh(files.path("once-" + name)), file.mesh(), Y, tents.extension);
  }
}

TEST(Extension, AttributesSurviveTheWayThroughAnotherFormat) {
  MeshFiles files;
  const auto& [name, bytes] = rich_files().front();
  const MeshFile obj = MeshFiles::read(bytes, name);
  const Tents tents(obj.mesh(), {0});
  files.write(obj, obj.mesh().X, tents.extension, "same.obj");
  const MeshAttributes direct = read_mesh(files.path("same.obj")).attributes();
  for (const char* target : {"b.ply", "b.off"}) {
    SCOPED_TRACE(target);
    WriteReport report;
    files.write(obj, obj.mesh().X, tents.extension, target, {}, &report);
    // The report notes the lost data once, and notes nothing about statements that the format does
    // not have.
    EXPECT_EQ(report.notes.size(), 1U);
    const MeshFile other = read_mesh(files.path(target));
    EXPECT_EQ(other.attributes().colours, direct.colours);
    EXPECT_TRUE(other.has_normals());
    ASSERT_EQ(other.attributes().corner_texture.size(), direct.corner_texture.size());
    for (std::size_t i = 0; i < direct.corner_texture.size(); ++i) {
      const auto at = [i](const MeshAttributes& attributes) {
        return attributes
            .texture_coordinates[static_cast<std::size_t>(attributes.corner_texture[i])];
      };
      EXPECT_EQ(at(other.attributes()), at(direct));
    }
  }
  // The colours of p, q and r are mixtures of red, green and blue with weights of a half, a quarter
  // and a quarter; a different colour has the weight of a half in each.
  ASSERT_EQ(direct.colours.size(), 7U);
  EXPECT_EQ(direct.colours[4], (std::array{0.5, 0.25, 0.25, 1.0}));
  EXPECT_EQ(direct.colours[5], (std::array{0.25, 0.5, 0.25, 1.0}));
  EXPECT_EQ(direct.colours[6], (std::array{0.25, 0.25, 0.5, 1.0}));
}

TEST(Extension, OfEveryReadableFileIsReadBack) {
  MeshFiles files;
  int read = 0;
  for (const auto& [name, bytes] : rich_files()) {
    for (std::size_t i = 0; i < bytes.size(); i += 5) {
      std::string changed = bytes;
      changed[i] = "9 \n#.\\-/f\xFF"[i / 5 % 10];
      try {
        const MeshFile file = MeshFiles::read(changed, name);
        ++read;
        const Tents tents(file.mesh(), {0});
        files.write(file, file.mesh().X, tents.extension, name);
        SCOPED_TRACE(changed);
        expect_extended(read_mesh(files.path(name)), file.mesh(), file.mesh().X, tents.extension);
      } catch (const BadFile& error) {
        EXPECT_EQ(std::string(error.what()).find(files.path(name)), std::string::npos);
      }
    }
  }
  EXPECT_GT(read, 40);
}

TEST(Extension, OfAWeldedFileIsGenerated) {
  MeshFiles files;
  const MeshFile file = MeshFiles::read(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\ng a\nf 1 2 3\ng b\nf 4 6 5\n", "a.obj",
      {.format = "obj", .weld = true});
  const Tents tents(file.mesh(), {0});
  WriteReport report;
  const std::string out = files.write(file, file.mesh().X, tents.extension, "b.obj", {}, &report);
  EXPECT_FALSE(report.patched);
  expect_extended(read_mesh(files.path("b.obj")), file.mesh(), file.mesh().X, tents.extension);
  EXPECT_NE(out.find("g b\nf 2 4 3\ng a\nf "), std::string::npos) << out;
}

TEST(Extension, ThatDoesNotFitIsRefused) {
  MeshFiles files;
  const MeshFile file = MeshFiles::read(rich_files().front().second, "a.obj");
  const Points& X = file.mesh().X;
  const Extension good = Tents(file.mesh(), {0}).extension;
  const auto refused = [&](auto&& spoil) {
    Extension bad = good;
    spoil(bad);
    for (const char* name : {"b.obj", "b.ply", "b.off"})
      EXPECT_THROW(write_mesh(file, X, bad, files.path(name)), BadMesh);
  };
  refused([](Extension& e) { e.model_face.pop_back(); });
  refused([](Extension& e) { e.model_face[0] = 2; });
  refused([](Extension& e) { e.model_face[0] = -1; });
  refused([](Extension& e) { e.rim[0] = 4; });
  refused([](Extension& e) { e.F(0, 0) = 7; });
  refused([](Extension& e) { e.F(0, 0) = -1; });
  refused([](Extension& e) { e.X(0, 0) = std::numeric_limits<double>::infinity(); });
  refused([](Extension& e) {
    e.extend = [](const Eigen::MatrixXd& at_rim) { return Eigen::MatrixXd(at_rim); };
    e.rim.push_back(3);
  });
  EXPECT_EQ(files.entries(), 0U);
}

TEST(Extension, LeavesTheTargetAloneWhereItFails) {
  MeshFiles files;
  for (const auto& [name, bytes] : rich_files()) {
    const MeshFile file = MeshFiles::read(bytes, name);
    Extension broken = Tents(file.mesh(), {0}).extension;
    broken.extend = [](const Eigen::MatrixXd&) -> Eigen::MatrixXd {
      throw FactorizationFailed("not positive definite");
    };
    write_bytes(files.path(name), "old");
    EXPECT_THROW(write_mesh(file, file.mesh().X, broken, files.path(name), {.overwrite = true}),
                 FactorizationFailed);
    EXPECT_EQ(read_bytes(files.path(name)), "old");
  }
  EXPECT_EQ(files.entries(), rich_files().size());
}

/// Checks the laws of an extension with tents over some faces of the file.
void expect_file_extended(const std::string& path) {
  SCOPED_TRACE(path);
  MeshFiles files;
  const MeshFile file = read_mesh(path);
  const Tents tents(file.mesh(), some_faces(file.mesh(), 501));
  const std::string copy = "copy." + std::string(file.format().name);
  const std::string out = files.write(file, file.mesh().X, tents.extension, copy);
  expect_extended(read_mesh(files.path(copy)), file.mesh(), file.mesh().X, tents.extension);
  if (file.format().name == "obj") {
    EXPECT_TRUE(out.starts_with(file.bytes().view()));
  }
}

TEST(RealFiles, AreExtended) {
  for (const std::string& path : project_meshes()) {
    expect_file_extended(path);
  }
}

TEST(SharedFiles, AreExtended) {
  const std::vector<std::string> paths = shared_meshes_below(700'000);
  if (paths.empty()) GTEST_SKIP() << "no ../shared/meshes";
  for (const std::string& path : paths) {
    expect_file_extended(path);
  }
}

}  // namespace
}  // namespace ibmfair::test
