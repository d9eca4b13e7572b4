// Output files appear complete or not at all, and a file in another format keeps all data that the
// format can hold.
#include <array>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/io/atomic_file.h"
#include "ibmfair/io/formats.h"
#include "support/files.h"
#include "support/mesh_io.h"
#include "support/meshes.h"

namespace ibmfair::test {
namespace {

std::string cannot_write(const std::string& path, bool overwrite) {
  try {
    AtomicFile out(path, overwrite);
    out.write(std::string(1 << 20, 'x'));
    out.commit();
  } catch (const CannotWrite& error) {
    return error.what();
  }
  return {};
}

TEST(AtomicFile, AppearsOnlyWhenCommitted) {
  const TemporaryDirectory directory;
  {
    AtomicFile out(directory / "a", false);
    out.write("lost");
    EXPECT_FALSE(std::filesystem::exists(directory / "a"));
  }
  EXPECT_EQ(directory.entries(), 0U);
  AtomicFile out(directory / "a", false);
  out.write("kept ");
  out.write_real(0.1);
  EXPECT_EQ(out.bytes(), 8);
  out.commit();
  EXPECT_EQ(read_bytes(directory / "a"), "kept 0.1");
  EXPECT_EQ(directory.entries(), 1U);
}

TEST(AtomicFile, ReplacesOnlyWhereAllowed) {
  const TemporaryDirectory directory;
  write_bytes(directory / "a", "old");
  chmod((directory / "a").c_str(), 0640);
  EXPECT_NE(cannot_write(directory / "a", false).find("--overwrite"), std::string::npos);
  EXPECT_EQ(read_bytes(directory / "a"), "old");
  EXPECT_EQ(cannot_write(directory / "a", true), "");
  EXPECT_EQ(read_bytes(directory / "a").size(), std::size_t{1} << 20);
  struct stat status {};
  stat((directory / "a").c_str(), &status);
  EXPECT_EQ(status.st_mode & 07777U, 0640U);
  EXPECT_EQ(directory.entries(), 1U);

  EXPECT_THROW(require_writable(directory / "a", false), CannotWrite);
  EXPECT_NO_THROW(require_writable(directory / "a", true));
  EXPECT_NO_THROW(require_writable(directory / "b", false));
  EXPECT_EQ(directory.entries(), 1U);
}

TEST(AtomicFile, NeverReplacesAFileThatAppearedMeanwhile) {
  const TemporaryDirectory directory;
  AtomicFile out(directory / "a", false);
  out.write("new");
  write_bytes(directory / "a", "somebody else's");
  EXPECT_THROW(out.commit(), CannotWrite);
  EXPECT_EQ(read_bytes(directory / "a"), "somebody else's");
}

TEST(AtomicFile, FollowsSymbolicLinks) {
  const TemporaryDirectory directory;
  std::filesystem::create_directory(directory / "elsewhere");
  write_bytes(directory / "elsewhere/file", "old");
  std::filesystem::create_symlink("elsewhere/file", directory / "link");
  std::filesystem::create_symlink("elsewhere/missing", directory / "dangling");
  EXPECT_EQ(cannot_write(directory / "link", true), "");
  EXPECT_NE(cannot_write(directory / "dangling", false).find("symbolic link"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(directory / "elsewhere/missing"));
  EXPECT_EQ(cannot_write(directory / "dangling", true), "");
  EXPECT_TRUE(std::filesystem::is_symlink(directory / "link"));
  EXPECT_EQ(read_bytes(directory / "elsewhere/file").size(), std::size_t{1} << 20);
  EXPECT_EQ(read_bytes(directory / "elsewhere/missing").size(), std::size_t{1} << 20);
}

TEST(AtomicFile, SaysWhatIsInTheWay) {
  const TemporaryDirectory directory;
  EXPECT_NE(cannot_write(directory / "missing/a", false).find("there is no folder"),
            std::string::npos);
  EXPECT_NE(cannot_write(directory / "", true).find("Is a directory"), std::string::npos);
  EXPECT_NE(cannot_write("/dev/full", false).find("No space left"), std::string::npos);
  EXPECT_EQ(cannot_write("/dev/null", false), "");
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  chmod(directory.path().c_str(), 0500);
  EXPECT_NE(cannot_write(directory / "a", false).find("Permission denied"), std::string::npos);
  chmod(directory.path().c_str(), 0700);
  write_bytes(directory / "a", "protected");
  chmod((directory / "a").c_str(), 0400);
  EXPECT_NE(cannot_write(directory / "a", true).find("Permission denied"), std::string::npos);
}

TEST(WriteMesh, OutputMayBeTheInput) {
  MeshFiles files;
  const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  write_bytes(files.path("a.obj"), text);
  const MeshFile file = read_mesh(files.path("a.obj"));
  Points X = file.mesh().X;
  X(0, 0) = 0.5;
  EXPECT_THROW(write_mesh(file, X, files.path("a.obj")), CannotWrite);
  EXPECT_EQ(read_bytes(files.path("a.obj")), text);
  EXPECT_EQ(files.write(file, X, "a.obj"), "v 0.5 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  // The bytes in memory are the bytes that were read, whatever has happened to the file since.
  EXPECT_EQ(files.write(file, file.mesh().X, "a.obj"), text);
}

TEST(WriteMesh, RefusesWhatItCannotWrite) {
  MeshFiles files;
  const MeshFile file = MeshFiles::read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "a.obj");
  Points X = file.mesh().X;
  X(1, 1) = std::nan("");
  EXPECT_THROW(write_mesh(file, X, files.path("b.obj")), BadMesh);
  EXPECT_THROW(write_mesh(file, X.topRows(2), files.path("b.obj")), BadMesh);
  EXPECT_THROW(write_mesh(file, file.mesh().X, files.path("b.vtk")), BadOption);
  EXPECT_THROW(write_mesh(file, file.mesh().X, files.path("b.obj.new")), BadOption);
  EXPECT_THROW(write_mesh(file, file.mesh().X, files.path("b"), {.format = "none"}), BadOption);
  EXPECT_THROW(write_mesh(file.mesh(), "-"), BadOption);
  EXPECT_EQ(files.entries(), 0U);
  const std::string copy = files.write(file, file.mesh().X, "b.new", {.format = "obj"});
  EXPECT_TRUE(copy.starts_with("v 0 0 0\n"));
}

TEST(WriteMesh, EveryFormatButStlHoldsEveryMesh) {
  MeshFiles files;
  for (const NamedMesh& named : all_meshes()) {
    for (const Format& format : formats()) {
      if (format.generate == nullptr || format.name == "stl") continue;
      SCOPED_TRACE(named.name + " " + std::string(format.name));
      const std::string path = files.path("a." + std::string(format.name));
      write_mesh(named.mesh, path, {.overwrite = true});
      const MeshFile again = read_mesh(path);
      EXPECT_EQ(again.mesh().X, named.mesh.X);
      EXPECT_EQ(again.mesh().faces.corner, named.mesh.faces.corner);
      EXPECT_EQ(again.mesh().faces.first, named.mesh.faces.first);
    }
  }
}

constexpr std::string_view rich_obj =
    "mtllib a.mtl\n# comment\n"
    "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 0.5\nv 1 1 0 1 1 1\n"
    "vt 0 0\nvt 1 0\nvt 0 1\nvt 0.5 0.5\nvn 0 0 1\n"
    "g a\nusemtl m\nf 1/1/1 2/2/1 3/3/1\nf 4/4/1 3/1/1 2/2/1\nl 1 2\n";

TEST(Convert, ObjToPlyKeepsColoursTextureAndNormals) {
  MeshFiles files;
  const MeshFile obj = MeshFiles::read(rich_obj, "a.obj");
  WriteReport report;
  files.write(obj, obj.mesh().X, "b.ply", {}, &report);
  EXPECT_FALSE(report.patched);
  ASSERT_EQ(report.notes.size(), 1U);
  for (const char* lost : {"'l' statements", "comments", "groups"}) {
    EXPECT_NE(report.notes[0].find(lost), std::string::npos) << report.notes[0];
  }
  const MeshFile ply = read_mesh(files.path("b.ply"));
  EXPECT_TRUE(ply.has_normals());
  const MeshAttributes before = obj.attributes();
  const MeshAttributes after = ply.attributes();
  EXPECT_EQ(after.colours, before.colours);
  ASSERT_EQ(after.corner_texture.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(after.texture_coordinates[static_cast<std::size_t>(after.corner_texture[i])],
              before.texture_coordinates[static_cast<std::size_t>(before.corner_texture[i])]);
  }
  const std::string back = files.write(ply, ply.mesh().X, "c.obj");
  EXPECT_NE(back.find("v 1 0 0 0 1 0\n"), std::string::npos);
  EXPECT_NE(back.find("vn 0 0 1\n"), std::string::npos);
  EXPECT_NE(back.find("f 1/1/1 2/2/2 3/3/3\n"), std::string::npos) << back;
}

TEST(Convert, OffHoldsTextureWithoutSeamsOnly) {
  MeshFiles files;
  const MeshFile obj = MeshFiles::read(rich_obj, "a.obj");
  WriteReport report;
  const std::string seams = files.write(obj, obj.mesh().X, "b.off", {}, &report);
  EXPECT_TRUE(seams.starts_with("CNOFF\n4 2 0\n0 0 0 0 0 1 1.0 0.0 0.0 1.0\n")) << seams;
  EXPECT_NE(report.notes.at(0).find("texture coordinates"), std::string::npos);

  const MeshFile off = MeshFiles::read(
      "STCOFF\n3 1 0\n0 0 0 255 0 128 7 0.5 0\n1 0 0 1 2 3 4 1 0\n0 1 0 0 0 0 0 0 1\n3 0 1 2\n",
      "a.off");
  files.write(off, off.mesh().X, "b.ply");
  const MeshFile ply = read_mesh(files.path("b.ply"));
  EXPECT_EQ(ply.attributes().colours, off.attributes().colours);
  EXPECT_EQ(ply.attributes().texture_coordinates, off.attributes().texture_coordinates);
  EXPECT_EQ(
      files.write(ply, ply.mesh().X, "c.off"),
      "STCOFF\n3 1 0\n0 0 0 255 0 128 7 0.5 0\n1 0 0 1 2 3 4 1 0\n0 1 0 0 0 0 0 0 1\n3 0 1 2\n");
}

TEST(Convert, WeldedFilesKeepTheirEncoding) {
  MeshFiles files;
  for (const std::string encoding : {"ascii", "binary_big_endian", "binary_little_endian"}) {
    const bool big = encoding == "binary_big_endian";
    std::string bytes =
        "ply\nformat " + encoding +
        " 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double "
        "z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
        "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
    if (encoding == "ascii") {
      bytes += "0 0 0 1 2 3\n1 0 0 4 5 6\n0 1 0 7 8 9\n1 0 0 0 0 0\n3 0 1 2\n3 2 3 0\n";
    } else {
      for (const auto& row : {std::array<int, 6>{0, 0, 0, 1, 2, 3},
                              {1, 0, 0, 4, 5, 6},
                              {0, 1, 0, 7, 8, 9},
                              {1, 0, 0, 0, 0, 0}}) {
        for (std::size_t i = 0; i < 6; ++i)
          bytes += to_bytes(row[i], i < 3 ? 8 : 1, big, i < 3);
      }
      for (const auto& row : {std::array<int, 4>{3, 0, 1, 2}, {3, 2, 3, 0}}) {
        for (std::size_t i = 0; i < 4; ++i)
          bytes += to_bytes(row[i], i == 0 ? 1 : 4, big, false);
      }
    }
    const MeshFile welded = MeshFiles::read(bytes, "a.ply", {.format = "ply", .weld = true});
    EXPECT_EQ(welded.mesh().faces.corner, (std::vector<Index>{0, 1, 2, 2, 1, 0}));
    const std::string out = files.write(welded, welded.mesh().X, "b.ply");
    EXPECT_NE(out.find("format " + encoding + " 1.0\nelement vertex 3\n"), std::string::npos);
    const MeshFile again = read_mesh(files.path("b.ply"));
    EXPECT_EQ(again.mesh().X, welded.mesh().X);
    EXPECT_EQ(again.mesh().faces.corner, welded.mesh().faces.corner);
    EXPECT_EQ(again.attributes().colours, welded.attributes().colours);
  }
}

TEST(Weld, MergesEqualPositionsOnly) {
  // A strip in which every position occurs with z = +0, with z = -0, and with the smallest z above
  // 0.
  std::string text;
  for (int i = 0; i < 300; ++i) {
    for (const char* z : {"0", "-0", "5e-324"})
      text += fmt::format("v {} {} {}\n", i, 0.1 * i, z);
  }
  const MeshFile file =
      MeshFiles::read(text + "f 1 4 7\nf 5 2 3\n", "a.obj", {.format = "obj", .weld = true});
  EXPECT_EQ(file.mesh().X.rows(), 600);
  EXPECT_EQ(file.mesh().faces.corner, (std::vector<Index>{0, 2, 4, 2, 0, 1}));
}

TEST(ReadMesh, FindsTheFormat) {
  const TemporaryDirectory directory;
  const std::string off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const std::string obj = "# x\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  write_bytes(directory / "a.OFF", off);
  write_bytes(directory / "b", off);
  write_bytes(directory / "c.v2", obj);
  write_bytes(directory / "d.obj", off);
  write_bytes(directory / "e.xyz", "1 2 3\n");
  EXPECT_EQ(read_mesh(directory / "a.OFF").format().name, "off");
  EXPECT_EQ(read_mesh(directory / "b").format().name, "off");
  EXPECT_EQ(read_mesh(directory / "c.v2").format().name, "obj");
  EXPECT_EQ(read_mesh(directory / "d.obj", {.format = "OFF"}).format().name, "off");
  EXPECT_THROW(read_mesh(directory / "d.obj"), BadFile);
  EXPECT_THROW(read_mesh(directory / "e.xyz"), BadFile);
  EXPECT_THROW(read_mesh(directory / "a.OFF", {.format = "none"}), BadOption);
  EXPECT_THROW(read_mesh(directory / "missing.obj"), BadFile);
  EXPECT_THROW(read_mesh(directory.path()), BadFile);
}

}  // namespace
}  // namespace ibmfair::test
