// OBJ: files are written back as they were read, and files that cannot be read are refused with the
// place of the error.
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/io/formats.h"
#include "support/mesh_io.h"

namespace ibmfair::test {
namespace {

constexpr std::string_view two_groups =
    "# a comment\n"
    "mtllib scene.mtl\n"
    "v 0 0 0\nv 1 0 0\nv 1 1 0.125\nv 0 1 0\n"
    "v 7 7 7\n"
    "v 2 0 -1e-3\nv 2 1 0\n"
    "g left part\nusemtl red\ns 1\n"
    "f 1 2 3 4\n"
    "g right\nusemtl blue metal\no thing\n"
    "f 2 6 7\nf 2 7 3\n";

TEST(ObjFile, KeepsPolygonsGroupsAndUnreferencedVertices) {
  const MeshFile file = expect_carried(two_groups, "a.obj");
  EXPECT_EQ(file.format().name, "obj");
  EXPECT_EQ(file.mesh().X.rows(), 7);
  ASSERT_EQ(file.mesh().faces.size(), 3);
  EXPECT_EQ(file.mesh().faces[0].size(), 4U);
  EXPECT_EQ(file.mesh().faces[2][1], 6);
}

TEST(ObjFile, MovingOneVertexChangesOneLine) {
  MeshFiles files;
  const MeshFile file = MeshFiles::read(two_groups, "a.obj");
  Points X = file.mesh().X;
  X(2, 1) = 0.1;
  WriteReport report;
  const std::string out = files.write(file, X, "b.obj", {}, &report);
  EXPECT_EQ(different_lines(out, two_groups), std::vector<int>{5});
  EXPECT_NE(out.find("\nv 1 0.1 0.125\n"), std::string::npos);
  EXPECT_TRUE(report.patched);
  EXPECT_EQ(report.moved_vertices, 1);
  EXPECT_EQ(report.bytes, static_cast<std::int64_t>(out.size()));
}

TEST(ObjFile, KeepsCutSeamsUnlessWelded) {
  constexpr std::string_view seam =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv 0 1 -0\nv 1 1 0\ng a\nf 1 2 3\ng b\nf 4 6 5\n";
  const MeshFile apart = expect_carried(seam, "a.obj");
  EXPECT_EQ(apart.mesh().X.rows(), 6);

  MeshFiles files;
  const MeshFile welded = MeshFiles::read(seam, "a.obj", {.format = "", .weld = true});
  EXPECT_TRUE(welded.welded());
  EXPECT_EQ(welded.mesh().faces.corner, (std::vector<Index>{0, 1, 2, 1, 3, 2}));
  ASSERT_EQ(welded.notes().size(), 1U);
  EXPECT_NE(welded.notes()[0].find("merged 2 vertices"), std::string::npos);
  EXPECT_EQ(welded.vertex_mask("b"), (std::vector<std::uint8_t>{0, 1, 1, 1}));
  WriteReport report;
  EXPECT_EQ(files.write(welded, welded.mesh().X, "b.obj", {}, &report),
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\ng a\nf 1 2 3\ng b\nf 2 4 3\n");
  EXPECT_FALSE(report.patched);
}

TEST(ObjFile, KeepsTheOrderOfFacesAndForwardReferences) {
  const MeshFile file =
      expect_carried("f 4 2 3\nf 3 2 1\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n", "a.obj");
  EXPECT_EQ(file.mesh().faces.corner, (std::vector<Index>{3, 1, 2, 2, 1, 0}));
}

TEST(ObjFile, KeepsTextureCoordinatesAndRenewsNormalsOfOneVertex) {
  constexpr std::string_view text =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 5 5 5\nv 6 5 5\nv 5 6 5\n"
      "vt 0.25 0.5\nvt 1 0\nvt 0 1\n"
      "vn 0 0 1\nvn 0 0 2\nvn 0 0 1\nvn 0 0 1\nvn 0 0 -1\nvn 0 0 1\nvn 0 0 1\n"
      "f 1/1/1 2/2/2 3/3/3\nf 2//2 4//4 3//3\nf 5//5 6//6 7//7\n";
  const MeshFile file = expect_carried(text, "a.obj");
  EXPECT_TRUE(file.has_texture_coordinates());
  EXPECT_TRUE(file.has_normals());

  MeshFiles files;
  Points X = file.mesh().X;
  X(3, 2) = 1.0;  // moves the second face only
  const std::string out = files.write(file, X, "b.obj");
  // The line of the vertex changes, and the lines of the normals of the three vertices whose second
  // face has moved.
  EXPECT_EQ(different_lines(out, text), (std::vector<int>{4, 12, 13, 14}));
  X = file.mesh().X;
  X.row(4) << 5, 5, 4;
  // A normal that pointed to the inside still points to the inside.
  const std::string inside = files.write(file, X, "b.obj");
  EXPECT_EQ(different_lines(inside, text), (std::vector<int>{5, 15, 16, 17}));
  const std::size_t at = inside.find("vn ", inside.find("vn 0 0 1\nvn 0 0 1\n") + 10);
  EXPECT_EQ(inside.substr(at, 6), "vn 0.5") << inside;
}

TEST(ObjFile, DropsNormalsThatSeveralVerticesShare) {
  constexpr std::string_view text =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvn 0 0 1\n"
      "f 1/1/1 2/1/1 3/1/1 # flat\nf 2//1 4//1 3//1\n";
  MeshFiles files;
  const MeshFile file = MeshFiles::read(text, "a.obj");
  Points X = file.mesh().X;
  X(3, 2) = 1.0;
  WriteReport report;
  EXPECT_EQ(files.write(file, X, "b.obj", {}, &report),
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\nvt 0 0\nf 1/1 2/1 3/1 # flat\nf 2 4 3\n");
  ASSERT_EQ(report.notes.size(), 1U);
  EXPECT_NE(report.notes[0].find("dropped the normals"), std::string::npos);
  EXPECT_EQ(files.write(file, file.mesh().X, "b.obj"), text);
}

TEST(ObjFile, KeepsColours) {
  MeshFiles files;
  constexpr std::string_view text =
      "v 0 0 0 0.1 0.2 0.3\nv 1 0 0 nan 0 0\nv 0 1 0 1 1 1\nf 1 2 3\n";
  const MeshFile file = expect_carried(text, "a.obj");
  Points X = file.mesh().X;
  X(0, 0) = -1.5;
  EXPECT_TRUE(
      files.write(file, X, "b.obj").starts_with("v -1.5 0 0 0.1 0.2 0.3\nv 1 0 0 nan 0 0\n"));
}

TEST(ObjFile, ReadsNumbersExactly) {
  const MeshFile file = expect_carried(
      "v 4500000.123456 1e-300 0.30000000000000004\nv +1 .5 -5.\nv 1e-400 -1E+2 4.9e-324\n"
      "f 1 2 3\n",
      "a.obj");
  const Points& X = file.mesh().X;
  EXPECT_EQ(X.row(0), Eigen::RowVector3d(4500000.123456, 1e-300, 0.30000000000000004));
  EXPECT_EQ(X.row(1), Eigen::RowVector3d(1, 0.5, -5));
  EXPECT_EQ(X.row(2), Eigen::RowVector3d(0, -100, 4.9e-324));
}

TEST(ObjFile, CountsNegativeIndicesFromTheEnd) {
  const MeshFile file =
      expect_carried("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 1 1 0\nf -1 -2 -3\n", "a.obj");
  EXPECT_EQ(file.mesh().faces.corner, (std::vector<Index>{0, 1, 2, 3, 2, 1}));
}

TEST(ObjFile, AcceptsEveryWayToLayOutLines) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    for (const bool mark : {false, true}) {
      for (const bool last : {false, true}) {
        const std::string text = fmt::format(
            "{1}v 0 0 0  \t{0}\tv\t1   0 0{0}{0}  v 0 1 0 # C:\\dir\\{0}f 1 \\{0} 2 3{0}f 3 2 1{2}",
            end, mark ? "\xEF\xBB\xBF" : "", last ? end : "");
        SCOPED_TRACE(testing::PrintToString(text));
        const MeshFile file = expect_carried(text, "a.obj");
        EXPECT_EQ(file.mesh().X.rows(), 3);
        EXPECT_EQ(file.mesh().faces.corner, (std::vector<Index>{0, 1, 2, 2, 1, 0}));
      }
    }
  }
}

TEST(ObjFile, CarriesWhatItDoesNotUnderstand) {
  const MeshFile file = expect_carried(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nvp 0.5\nl 1 2 3\np 1\nf 1 2 3\ncurv 0 1 1 2 \\\n3\n"
      "call x.obj\nv2 oops\n??? \x80\xFF\nend\n",
      "a.obj");
  EXPECT_EQ(file.mesh().X.rows(), 3);
  EXPECT_EQ(file.mesh().faces.size(), 1);
}

TEST(ObjFile, CountsStatementsWithUnknownKeywords) {
  const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  // Every keyword of the format is known, also those of free-form geometry.
  const MeshFile known = expect_carried(
      mesh +
          "l 1 2\np 1\nvp 0 0\ncstype bezier\ndeg 3\ncurv 0 1 1 2 3\nparm u 0 1\nend\n"
          "mtllib a\nusemtl b\ng c\no d\ns 1\nlod 1\n# t\n",
      "a.obj");
  EXPECT_EQ(known.unknown_statements().count, 0);
  EXPECT_TRUE(known.warnings().empty());
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const std::string text =
        replaced(mesh + "# t\n  t 1//4 2 \\\n 3\nF 1 2 3\nl 1 2\nfoo\n", "\n", end);
    const MeshFile file = expect_carried(text, "a.obj");
    EXPECT_EQ(file.unknown_statements().count, 3);
    EXPECT_EQ(file.unknown_statements().line, 6);
    EXPECT_EQ(file.unknown_statements().keyword, "t");
    ASSERT_EQ(file.warnings().size(), 1U);
    EXPECT_TRUE(file.warnings()[0].starts_with("a.obj:6:3: ")) << file.warnings()[0];
  }
}

TEST(ObjFile, NamesUnknownKeywordsWhereNoFaceIsLeft) {
  const std::string message = read_error("v 0 0 0\nv 1 0 0\nv 0 1 0\nF 1 2 3\nF 1 2 3\n", "a.obj");
  EXPECT_EQ(message,
            "a.obj: the mesh has no faces; line 4 starts with the unknown keyword 'F' (such "
            "lines: 2)");
}

TEST(ObjFile, CarriesLargePolygonsAndLongComments) {
  std::string text = "#" + std::string(200000, 'x') + "\n";
  std::string face = "f";
  for (int i = 0; i < 300; ++i) {
    text += "v " + std::to_string(std::cos(i * 0.0209)) + " " +
            std::to_string(std::sin(i * 0.0209)) + " 0\n";
    face += " " + std::to_string(i + 1);
  }
  const MeshFile file = expect_carried(text + face + "\n", "a.obj");
  EXPECT_EQ(file.mesh().faces[0].size(), 300U);
  EXPECT_EQ(triangulate(file.mesh()).F.rows(), 298);
}

TEST(ObjFile, CarriesRepeatedCorners) {
  const MeshFile file = expect_carried("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 2\nf 1 2 3\n", "a.obj");
  EXPECT_EQ(file.mesh().faces.size(), 2);
}

TEST(ObjFile, RefusesWithLineColumnAndWord) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const auto refused = [&](const std::string& text) { return read_error(text, "a.obj"); };
  EXPECT_EQ(refused(triangle + "f 1 2 0\n"), "a.obj:4:7: vertices are counted from 1 in '0'");
  EXPECT_EQ(refused(triangle + "f 1 2 4/1\n"),
            "a.obj:4:7: there is no such vertex (the file has 3) in '4/1'");
  EXPECT_EQ(refused(triangle + "f 1 2 4294967297\r\n"),
            "a.obj:4:7: there is no such vertex (the file has 3) in '4294967297'");
  EXPECT_EQ(refused(triangle + "f 1 2 99999999999999999999999\n"),
            "a.obj:4:7: there is no such vertex (the file has 3) in '99999999999999999999999'");
  EXPECT_EQ(refused(triangle + "f 1 2 -4\n"),
            "a.obj:4:7: there are not that many vertices before this face in '-4'");
  EXPECT_EQ(refused(triangle + "f 1 2 x\n"), "a.obj:4:7: not a vertex number in 'x'");
  EXPECT_EQ(refused(triangle + "f 1 2 3x\n"), "a.obj:4:7: not a vertex number in '3x'");
  EXPECT_EQ(refused(triangle + "f 1 2 3/1/0\n"),
            "a.obj:4:7: normals are counted from 1 in '3/1/0'");
  EXPECT_EQ(refused(triangle + "f 1 2\n"), "a.obj:4:1: a face needs at least three corners in 'f'");
  EXPECT_EQ(refused("\r\rv 1 2\rf 1 1 1"), "a.obj:3:6: a number is missing at the end of the line");
  EXPECT_EQ(refused("v 1 2"), "a.obj:1:6: a number is missing at the end of the file");
  EXPECT_EQ(refused("v 1 2 abc\n"), "a.obj:1:7: not a number in 'abc'");
  EXPECT_EQ(refused("\nv 0,5 1 2\n"), "a.obj:2:3: not a number in '0,5'");
  EXPECT_EQ(refused("v 1 2 nan\n"), "a.obj:1:7: not a finite number in 'nan'");
  EXPECT_EQ(refused("v 1 -inf 2\n"), "a.obj:1:5: not a finite number in '-inf'");
  EXPECT_EQ(refused("v 1 1e400 2\n"),
            "a.obj:1:5: number too large for double precision in '1e400'");
  EXPECT_EQ(refused("v 1 2 3 0.5\n"),
            "a.obj:1:9: rational vertices (a weight other than 1) are not supported in '0.5'");
}

TEST(ObjFile, RefusesWhatIsNoMesh) {
  const auto refused = [](std::string_view bytes) { return read_error(bytes, "a.obj"); };
  EXPECT_EQ(refused(""), "a.obj: the mesh has no vertices");
  EXPECT_EQ(refused("# nothing\n"), "a.obj: the mesh has no vertices");
  EXPECT_EQ(refused("v 1 2 3\n"), "a.obj: the mesh has no faces");
  EXPECT_EQ(refused(std::string("v 1 2\0 3", 8)), "a.obj: not an OBJ text (byte 5 is zero)");
  const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n# " + std::string(2000, 'x');
  EXPECT_EQ(refused(text + '\0'), "a.obj: not an OBJ text (byte 2034 is zero)");
  EXPECT_EQ(refused("\xFE\xFF v"), "a.obj: the text is UTF-16; save it as UTF-8");
}

TEST(ObjFile, SurvivesRandomBytes) {
  std::uint32_t state = 1;
  for (int round = 0; round < 300; ++round) {
    std::string bytes = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (int i = 0; i < 200; ++i) {
      state = state * 1664525 + 1013904223;
      constexpr std::string_view alphabet = "vfvfnt 0123456789-+.e/\\#\n\r\t\x01\xFF";
      bytes += alphabet[(state >> 16) % alphabet.size()];
    }
    try {
      const MeshFile file = MeshFiles::read(bytes, "a.obj");
      write_mesh(file, mostly_moved(file.mesh().X), "/dev/null", {.format = "obj"});
    } catch (const BadFile& error) {
      EXPECT_NE(std::string(error.what()), "");
    }
  }
}

TEST(ObjFile, NamesOfGroupsMayGoOnOnTheNextLine) {
  for (const std::string continuation : {"\\\n", " \\\n", "\\\n ", "\\\r\n"}) {
    // The second line of the name looks like a face with a vertex that does not exist.
    const std::string text =
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 2 4 3\ng left" + continuation + "f 1 2 9\nf 1 2 3\n";
    const MeshFile file = expect_carried(text, "a.obj");
    ASSERT_EQ(file.mesh().faces.size(), 2);
    for (const std::string name : {"left", "f", "9"})
      EXPECT_EQ(file.vertex_mask(name), (std::vector<std::uint8_t>{1, 1, 1, 0})) << name;
  }
  // At the end of the file, a backslash continues nothing.
  for (const std::string end : {"\\", " \\", " x\\", "\\\n", " \\ "}) {
    const MeshFile last = MeshFiles::read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\ng" + end, "a.obj");
    EXPECT_THROW(last.vertex_mask("left"), BadOption) << end;
  }
  const MeshFile file = MeshFiles::read(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\ng C:\\parts\\\nf 1 2 3\n"
      "g other\\\\part\nf 1 2 3\n",
      "a.obj");
  ASSERT_EQ(file.mesh().faces.size(), 1);
  EXPECT_EQ(file.vertex_mask("other\\\\part"), (std::vector<std::uint8_t>{1, 1, 1}));
  EXPECT_THROW(file.vertex_mask("C:\\parts\\"), BadOption);
}

TEST(ObjFile, SelectsVerticesByGroupObjectAndMaterial) {
  MeshFiles files;
  const MeshFile file = MeshFiles::read(two_groups, "a.obj");
  using Mask = std::vector<std::uint8_t>;
  const Mask left{1, 1, 1, 1, 0, 0, 0};
  const Mask right{0, 1, 1, 0, 0, 1, 1};
  EXPECT_EQ(file.vertex_mask("left"), left);
  EXPECT_EQ(file.vertex_mask("part"), left);
  EXPECT_EQ(file.vertex_mask("red"), left);
  EXPECT_EQ(file.vertex_mask("blue metal"), right);
  EXPECT_EQ(file.vertex_mask("thing"), right);
  try {
    file.vertex_mask("middle");
    FAIL() << "an unknown name must be refused";
  } catch (const BadOption& error) {
    EXPECT_NE(std::string(error.what()).find("blue metal, left, part, red, right, thing"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace ibmfair::test
