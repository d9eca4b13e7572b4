// What each format's file looks like once something is put behind its vertices and faces.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/io/formats.h"
#include "support/extensions.h"
#include "support/mesh_io.h"

namespace ibmfair::test {
namespace {

/// Writes a tent over one face of a file, of the same format.
std::string with_tent(std::string_view bytes, const std::string& name, Index face = 0,
                      WriteReport* report = nullptr, WriteOptions options = {}) {
  MeshFiles files;
  const MeshFile file = MeshFiles::read(bytes, name);
  return files.write(file, file.mesh().X, Tents(file.mesh(), {face}).extension, name, options,
                     report);
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
  return text;
}

constexpr std::string_view groups =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\ng a\ns 1\nusemtl m\nf 4 3 2\no b\ng b c\n"
    "usemtl n\nf -4 -3 -1";

TEST(ExtendedObj, TakesTheStateOfTheModelFace) {
  const std::string vertices =
      "\nv 0.75 0.75 0.3333333333333333\nv 0.5 0.75 0.25\nv 0.75 0.5 0.2\n";
  WriteReport report;
  EXPECT_EQ(with_tent(groups, "a.obj", 1, &report),
            std::string(groups) + vertices +
                "g a\nusemtl m\nf 3 2 5\nf 2 4 5\nf 4 3 6\nf 3 5 6\nf 5 4 6\nf 5 6 7\n");
  // No statement takes faces out of an object.
  ASSERT_EQ(report.notes.size(), 1U);
  EXPECT_NE(report.notes[0].find("6 new faces beside faces without object"), std::string::npos);

  const std::string last = with_tent(groups, "a.obj", 2, &report);
  EXPECT_EQ(last.find('g', groups.size()), std::string::npos) << last;
  EXPECT_TRUE(report.notes.empty());

  const std::string first = with_tent(groups, "a.obj", 0, &report);
  EXPECT_NE(first.find("\ng default\ns off\nf 2 3 5\n"), std::string::npos) << first;
  EXPECT_EQ(report.notes.size(), 2U);  // nor out of a material
}

TEST(ExtendedObj, RepeatsStatementsOnlyWhereTheyChange) {
  MeshFiles files;
  const MeshFile file = MeshFiles::read(groups, "a.obj");
  const Tents tents(file.mesh(), {1, 2, 1});
  const std::string out = files.write(file, file.mesh().X, tents.extension, "a.obj");
  const std::string added = out.substr(groups.size());
  const auto count = [&](const std::string& line) {
    std::size_t n = 0;
    for (std::size_t at = 0; (at = added.find(line, at)) != std::string::npos; ++at)
      ++n;
    return n;
  };
  EXPECT_EQ(count("\ng a\n"), 2U);
  EXPECT_EQ(count("\ng b c\n"), 1U);
  EXPECT_EQ(count("\nusemtl m\n"), 2U);
  EXPECT_EQ(count("\nusemtl n\n"), 1U);
  EXPECT_EQ(count("\ns "), 0U);
}

TEST(ExtendedObj, KeepsToTheLinesOfTheFile) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    for (const std::string& last : {std::string(), end, " \\" + end, "#\\" + end, end + "#\\"}) {
      for (const bool mark : {false, true}) {
        const std::string text =
            (mark ? "\xEF\xBB\xBF" : "") +
            replaced("v 0 0 0\nv 1 0 0\nv 0 1 0\n# C:\\\ng x\nf 1 2 3", "\n", end) + last;
        SCOPED_TRACE(testing::PrintToString(text));
        const std::string out = with_tent(text, "a.obj");
        ASSERT_EQ(out.substr(0, text.size()), text);
        // Nothing but the line end of the file, and only one behind each line.
        const std::string added = replaced(out.substr(text.size()), end, "\n");
        EXPECT_EQ(added.find('\r'), std::string::npos);
        EXPECT_TRUE(added.ends_with("f 4 5 6\n"));
        const Mesh mesh = MeshFiles::read(out, "a.obj").mesh();
        EXPECT_EQ(mesh.X.rows(), 6);
        EXPECT_EQ(mesh.faces.size(), 7);
      }
    }
  }
}

TEST(ExtendedObj, ContinuesTextureCoordinatesAndNormalsOfTheModelFace) {
  // Vertex 2 has a texture seam; normals point to the inside of the second face.
  constexpr std::string_view text =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvt 9 9\nvn 0 0 -1\nvn 0 0 1\n"
      "f 1/1/2 2/2/2 3/3/2\nf 4/-1/1 3/-1/1 2/-1/1\n";
  const std::string tents_normals = with_tent(text, "a.obj", 0).substr(text.size());
  EXPECT_NE(tents_normals.find("\nvt 0.25 0.25\nvt 0.5 0.25\nvt 0.25 0.5\nvn "), std::string::npos);
  EXPECT_NE(tents_normals.find("\nf 2/2/2 3/3/2 5/5/3\n"), std::string::npos) << tents_normals;
  EXPECT_NE(tents_normals.find("\nf 5/5/3 6/6/4 7/7/5\n"), std::string::npos);

  const std::string other = with_tent(text, "a.obj", 1).substr(text.size());
  EXPECT_NE(other.find("\nvt 9 9\nvt 9 9\nvt 9 9\n"), std::string::npos);
  EXPECT_NE(other.find("\nf 3/4/1 2/4/1 5/5/3\n"), std::string::npos) << other;

  const auto height_of_first_normal = [](const std::string& added) {
    const std::string row = added.substr(added.find("\nvn ") + 4);
    return std::stod(row.substr(row.rfind(' ', row.find('\n'))));
  };
  EXPECT_GT(height_of_first_normal(tents_normals), 0.5);
  EXPECT_LT(height_of_first_normal(other), -0.5);
}

TEST(ExtendedObj, GivesUpNormalsWithThoseOfTheFile) {
  // Both vertices of the shared normal are in a face that moves: it is dropped.
  constexpr std::string_view text =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\nf 4//1 3//1 2//1\n";
  MeshFiles files;
  const MeshFile file = MeshFiles::read(text, "a.obj");
  Points X = file.mesh().X;
  X(3, 2) = 1.0;
  const std::string out =
      files.write(file, X, Tents(file.mesh(), {0}).extension, "b.obj", {}, nullptr);
  EXPECT_EQ(out.find("vn"), std::string::npos);
  EXPECT_EQ(out.find('/'), std::string::npos);
  EXPECT_EQ(read_mesh(files.path("b.obj")).mesh().faces.size(), 8);
}

TEST(ExtendedObj, ExtendsWhatOnlyAPartOfTheRimHas) {
  // Vertices 1 and 2 have colours; only the first corner of the quadrilateral has texture.
  constexpr std::string_view text =
      "v 0 0 0 1 0.5 0\nv 1 0 0 0 0.5 0.25\nv 1 1 0\nv 0 1 0\nvt 0.5 0.25\n"
      "f 1/1 2 3 4\n";
  const std::string added = with_tent(text, "a.obj").substr(text.size());
  // p is 1/2 of the first and 1/4 of the second; r is 1/4 and 1/8 of them.
  EXPECT_NE(added.find(" 0.6666666666666666 0.5 0.08333333333333333\n"), std::string::npos)
      << added;
  EXPECT_NE(added.find("vt 0.5 0.25\n"), std::string::npos);
  // No face has texture coordinates at some of its corners only, but one of new vertices has.
  EXPECT_NE(added.find("\nf 2 3 5\n"), std::string::npos);
  EXPECT_NE(added.find("\nf 5/2 6/3 7/4\n"), std::string::npos);
}

/// A row of a PLY body: each value with the type that it is stored as.
using Row = std::vector<std::pair<std::string, double>>;

struct PlyText {
  std::string encoding = "ascii";
  std::string index = "int";
  std::string real = "double";
  std::string end = "\n";
  bool last_end = true;

  std::string line(const std::string& text) const { return text + end; }

  std::string rows(const std::vector<Row>& rows) const {
    std::string bytes;
    for (const Row& row : rows) {
      for (std::size_t i = 0; i < row.size(); ++i) {
        const auto& [type, value] = row[i];
        const bool real_type = type == "double" || type == "float";
        const int size = type == "double"                      ? 8
                         : type == "uchar" || type == "uint8"  ? 1
                         : type == "short" || type == "ushort" ? 2
                                                               : 4;
        if (encoding != "ascii") {
          bytes += to_bytes(value, size, encoding == "binary_big_endian", real_type);
        } else {
          const double shown = value;
          bytes +=
              (i > 0 ? " " : "") + (type == "float" ? fmt::format("{}", static_cast<float>(shown))
                                                    : fmt::format("{}", shown));
        }
      }
      if (encoding == "ascii") bytes += end;
    }
    return bytes;
  }

  /// Faces first, an element that nobody knows, and vertices with a bit of everything.
  std::string file(const std::vector<Row>& faces, const std::vector<Row>& vertices) const {
    std::string text =
        line("ply") + line("format " + encoding + " 1.0") + line("comment 7 vertex") +
        line(fmt::format("element face {}", faces.size())) +
        line("property list uchar " + index + " vertex_indices") + line("property short flag") +
        line("property list uchar uchar extra") + line("element other 1") +
        line("property list uint double values") +
        line(fmt::format("element vertex {}", vertices.size())) + line("property " + real + " z") +
        line("property list uchar ushort tags") + line("property " + real + " x") +
        line("property double y") + line("property uchar red") + line("property uchar green") +
        line("property uchar blue") + line("property int label") + line("property float quality") +
        line("end_header");
    text += rows(faces) + rows({{{"uint", 1}, {"double", 0.1}}}) + rows(vertices);
    if (encoding == "ascii" && !last_end) text.resize(text.size() - end.size());
    return text;
  }

  Row face(const std::vector<double>& corners, double flag, bool extra) const {
    Row row{{"uchar", static_cast<double>(corners.size())}};
    for (const double v : corners)
      row.emplace_back(index, v);
    row.emplace_back("short", flag);
    row.emplace_back("uchar", extra ? 2 : 0);
    if (extra) row.insert(row.end(), {{"uchar", 7}, {"uchar", flag + 10}});
    return row;
  }

  Row vertex(const Eigen::RowVector3d& x, int tags, const Eigen::RowVector3d& rgb, double label,
             double quality) const {
    Row row{{real, x[2]}, {"uchar", tags}};
    for (int i = 0; i < tags; ++i)
      row.emplace_back("ushort", i);
    for (const auto& [type, value] : Row{{real, x[0]},
                                         {"double", x[1]},
                                         {"uchar", rgb[0]},
                                         {"uchar", rgb[1]},
                                         {"uchar", rgb[2]},
                                         {"int", label},
                                         {"float", quality}}) {
      row.emplace_back(type, value);
    }
    return row;
  }
};

/// Four vertices; a quadrilateral and a triangle. With `tent`, one over the triangle behind them.
std::string ply_file(const PlyText& text, bool tent) {
  std::vector<Row> faces{text.face({0, 1, 2, 3}, -2, true), text.face({3, 1, 0}, 5, true)};
  std::vector<Row> vertices{text.vertex({0, 0, 0.5}, 1, {255, 0, 0}, 11, 0.5),
                            text.vertex({1, 0, 0.5}, 0, {0, 255, 0}, 12, 0.25),
                            text.vertex({1, 1, 0.5}, 2, {1, 2, 3}, 13, 0.125),
                            text.vertex({0, 1, 0.5}, 3, {0, 0, 9}, 14, 1)};
  if (tent) {
    // The corners are 3, 1 and 0; p's nearest vertex is 1, q's is 3, and r's that of p.
    vertices.push_back(text.vertex({0.25, 0.5, 0.5 + 1.0 / 3.0}, 0, {64, 64, 5}, 12, 0.6875));
    vertices.push_back(text.vertex({0.5, 0.25, 0.75}, 0, {64, 128, 2}, 14, 0.5));
    vertices.push_back(text.vertex({0.25, 0.25, 0.7}, 0, {128, 64, 2}, 12, 0.5625));
    for (const std::vector<double>& corners : std::vector<std::vector<double>>{
             {1, 0, 4}, {0, 3, 4}, {3, 1, 5}, {1, 4, 5}, {4, 3, 5}, {4, 5, 6}}) {
      faces.push_back(text.face(corners, 5, true));
    }
  }
  return text.file(faces, vertices);
}

TEST(ExtendedPly, IsTheFileThatOneWouldWriteByHand) {
  for (const std::string encoding : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    for (const std::string end : {"\n", "\r\n", "\r"}) {
      for (const std::string index : {"int", "uchar", "ushort", "uint"}) {
        PlyText text{.encoding = encoding, .index = index, .end = end};
        SCOPED_TRACE(encoding + " " + index + " " + testing::PrintToString(end));
        WriteReport report;
        EXPECT_EQ(with_tent(ply_file(text, false), "a.ply", 1, &report), ply_file(text, true));
        EXPECT_TRUE(report.notes.empty());
        if (encoding != "ascii") continue;
        // The new rows are ended whether the file's last one was or not.
        text.last_end = false;
        const std::string without = ply_file(text, false);
        text.last_end = true;
        EXPECT_EQ(with_tent(without, "a.ply", 1), ply_file(text, true));
      }
    }
  }
}

TEST(ExtendedPly, PromotesOrRoundsFloats) {
  for (const std::string encoding : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    SCOPED_TRACE(encoding);
    const PlyText single{.encoding = encoding, .real = "float"};
    const std::string source = ply_file(single, false);
    WriteReport report;
    EXPECT_EQ(with_tent(source, "a.ply", 1, &report),
              ply_file({.encoding = encoding, .real = "double"}, true));
    EXPECT_EQ(report.notes.size(), 1U);
    WriteOptions keep;
    keep.ply_real = WriteOptions::PlyReal::keep;
    EXPECT_EQ(with_tent(source, "a.ply", 1, &report, keep), ply_file(single, true));
    EXPECT_EQ(report.notes.size(), 1U);

    // Faces alone need no other type.
    MeshFiles files;
    const MeshFile file = MeshFiles::read(source, "a.ply");
    Extension faces;
    faces.F = Triangles{{3, 2, 1}};
    faces.model_face = {1};
    files.write(file, file.mesh().X, faces, "b.ply", {}, &report);
    EXPECT_TRUE(report.notes.empty());
    EXPECT_EQ(read_mesh(files.path("b.ply")).mesh().faces.size(), 3);
  }
}

TEST(ExtendedPly, WidensVertexNumbersThatGrowTooLarge) {
  const auto file_of = [](const std::string& encoding, const std::string& index, int vertices) {
    const PlyText text{.encoding = encoding, .index = index};
    std::vector<Row> rows;
    for (int v = 0; v < vertices; ++v)
      rows.push_back(text.vertex(Eigen::RowVector3d(v, v % 2, 0.5), 0, {0, 0, 0}, 0, 0));
    const std::vector<Row> faces{text.face({0, 1, 2}, 1, false),
                                 text.face({0, 127, 126, 125}, 2, true)};
    return text.file(faces, rows);
  };
  for (const std::string encoding : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    for (const int vertices : {253, 254}) {
      const std::string source = file_of(encoding, "uchar", vertices);
      WriteReport report;
      const std::string out = with_tent(source, "a.ply", 0, &report);
      const bool fits = vertices == 253;
      SCOPED_TRACE(encoding + (fits ? "" : " widened"));
      EXPECT_EQ(report.notes.size(), fits ? 0U : 1U);
      EXPECT_EQ(out.find("list uchar int vertex_indices") == std::string::npos, fits);
      const MeshFile again = MeshFiles::read(out, "a.ply");
      EXPECT_EQ(again.mesh().X.rows(), vertices + 3);
      EXPECT_EQ(again.mesh().faces.corner.back(), vertices + 2);
      EXPECT_EQ(std::vector<Index>(again.mesh().faces.corner.begin(),
                                   again.mesh().faces.corner.begin() + 7),
                (std::vector<Index>{0, 1, 2, 0, 127, 126, 125}));
    }
  }
}

TEST(ExtendedPly, ContinuesTextureCoordinatesOfCornersAndNormals) {
  constexpr std::string_view text =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
      "property double z\nproperty float nx\nproperty float ny\nproperty float nz\n"
      "element face 2\nproperty list uchar int vertex_index\nproperty list uchar float texcoord\n"
      "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n"
      "0 0 0 0 0 -1\n1 0 0 0 0 -1\n0 1 0 0 0 -1\n1 1 0 0 0 1\n"
      "3 0 1 2 6 0 0 1 0 0 1\n3 3 2 1 0\n0 1\n";
  WriteReport report;
  const std::string out = with_tent(text, "a.ply", 0, &report);
  EXPECT_TRUE(report.notes.empty());
  EXPECT_NE(out.find("3 3 2 1 0\n3 1 2 4 6 1 0 0 1 0.25 0.25\n"), std::string::npos) << out;
  EXPECT_NE(out.find("3 4 5 6 6 0.25 0.25 0.5 0.25 0.25 0.5\n0 1\n"), std::string::npos) << out;
  const std::string p = out.substr(out.find("\n0.25 0.25 0.3333333333333333 ") + 1);
  EXPECT_LT(std::stod(p.substr(p.rfind(' ', p.find('\n')))), -0.5);

  const std::string without = with_tent(text, "a.ply", 1, &report);
  EXPECT_NE(without.find("3 4 5 6 0\n0 1\n"), std::string::npos) << without;
  ASSERT_EQ(report.notes.size(), 1U);
  EXPECT_NE(report.notes[0].find("6 new faces have no texture coordinates"), std::string::npos);
}

TEST(ExtendedPly, AddsTriangleStrips) {
  constexpr std::string_view text =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
      "property double z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n4 0 1 2 3\n";
  const std::string out = with_tent(text, "a.ply", 1);
  EXPECT_NE(out.find("element tristrips 7\n"), std::string::npos);
  EXPECT_NE(out.find("\n4 0 1 2 3\n3 1 3 4\n"), std::string::npos) << out;
  EXPECT_EQ(MeshFiles::read(out, "a.ply").mesh().faces.size(), 8);

  const std::string rich =
      replaced(replaced(std::string(text), "end_header", "property int n\nend_header"), "4 0 1 2 3",
               "4 0 1 2 3 9");
  EXPECT_THROW(with_tent(rich, "a.ply"), CannotWrite);
}

TEST(ExtendedOff, KeepsToTheLayoutOfTheNumbers) {
  for (const std::string_view text : {
           "OFF\n4 2 5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n",
           "OFF 4 2 5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3",
           "OFF4 2\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3",
           "4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n",
           "#\n\nOFF # a\n#\n4 2 # b\n0 0 0#red\n1 0 0\n#\n1 1 0\n\n0 1 0#\n3 0 1 2 # c\n3 0 2 "
           "3\n#",
           "OFF\n4 2 5\n0 0 0\n1 0 0\n1 1 0\n0 1 0 # last\n3 0 1 2\n3 0 2 3 # without an end",
           "OFF\r\n4 2 5\r\n0 0 0\r\n1 0 0\r\n1 1 0\r\n0 1 0\r\n3 0 1 2\r\n3 0 2 3\r\n",
           "OFF\r4 2 5\r0 0 0\r1 0 0\r1 1 0\r0 1 0\r3 0 1 2\r3 0 2 3",
           "OFF 4 2 5 0 0 0 1 0 0 1 1 0 0 1 0 3 0 1 2 3 0 2 3",
           "OFF\n4 2 5\n0 0 0 1 0 0 1 1 0 0 1 0\n3 0 1 2 3 0 2 3 # c\n",
           "OFF\n4 2 5\n0 0 0 1 0 0 1 1 0 0 1 0 3 0 1 2\n3 0 2 3\n",
           "OFF\n4 2 5\n0 0 0\n1 0\n0\n1 1 0\n0 1 0\n3\n0\n1\n2\n\n3 0 2\n3\n",
           "OFF\n4 2 5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 255 0 0\n3 0 2 3  0.1 0.2 0.3 1\n",
       }) {
    SCOPED_TRACE(text);
    MeshFiles files;
    const MeshFile file = MeshFiles::read(text, "a.off");
    const Tents tents(file.mesh(), {0, 1});
    const std::string out = files.write(file, file.mesh().X, tents.extension, "a.off");
    const MeshFile again = MeshFiles::read(out, "a.off");
    ASSERT_EQ(again.mesh().X.rows(), 10);
    EXPECT_EQ(again.mesh().X.topRows(4), file.mesh().X);
    EXPECT_EQ(again.mesh().X.bottomRows(6), tents.extension.X);
    ASSERT_EQ(again.mesh().faces.size(), 14);
    EXPECT_EQ(again.mesh().faces.corner[6], 1);
    EXPECT_EQ(again.mesh().faces.corner.back(), 9);
    // Without the new rows and with the old counts it is the source.
    std::string counted(text);
    const bool edges = text.find("4 2 5") != std::string_view::npos;
    counted.replace(counted.find("4 2"), edges ? 5 : 3, edges ? "10 14 21" : "10 14");
    std::size_t kept = 0;
    for (const char c : out) {
      if (kept < counted.size() && c == counted[kept]) ++kept;
    }
    EXPECT_EQ(kept, counted.size()) << out;
    const bool one_line_end =
        text.find('\r') == std::string_view::npos ||
        std::count(out.begin(), out.end(), '\n') ==
            (text.find('\n') == std::string_view::npos ? 0
                                                       : std::count(out.begin(), out.end(), '\r'));
    EXPECT_TRUE(one_line_end) << testing::PrintToString(out);
  }
}

TEST(ExtendedOff, CountsEdgesWhereTheFileDoes) {
  const std::string rows = "\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
  // Three edges to p, three to q, two to r.
  EXPECT_TRUE(with_tent("OFF\n4 2 5" + rows, "a.off").starts_with("OFF\n7 8 13\n"));
  EXPECT_TRUE(with_tent("OFF\n4 2 0" + rows, "a.off").starts_with("OFF\n7 8 0\n"));
  EXPECT_TRUE(with_tent("OFF\n4 2" + rows, "a.off").starts_with("OFF\n7 8\n"));
}

TEST(ExtendedOff, ExtendsWhatFollowsEachPosition) {
  EXPECT_EQ(with_tent("COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 0 255 0 255\n0 1 0 0 0 9 255\n"
                      "3 0 1 2 1 0 0 # red\n",
                      "a.off"),
            "COFF\n6 7 0\n0 0 0 255 0 0 255\n1 0 0 0 255 0 255\n0 1 0 0 0 9 255\n"
            "0.25 0.25 0.3333333333333333 128 64 2 255\n0.5 0.25 0.25 64 128 2 255\n"
            "0.25 0.5 0.2 64 64 5 255\n3 0 1 2 1 0 0 # red\n3 1 2 3 1 0 0\n3 2 0 3 1 0 0\n"
            "3 0 1 4 1 0 0\n3 1 3 4 1 0 0\n3 3 0 4 1 0 0\n3 3 4 5 1 0 0\n");
  const std::string fractions = with_tent(
      "STCOFF\n3 1 0\n0 0 0 1 0 0 0.5 1\n1 0 0 1 1 0 0 1\n0 1 0 1 0 0.5 0 0\n3 0 1 2\n", "a.off");
  EXPECT_NE(fractions.find("\n0.25 0.25 0.3333333333333333 1.0 0.25 0.125 0.25 0.75\n"),
            std::string::npos)
      << fractions;
  const std::string normals =
      with_tent("NOFF\n3 1 0\n0 0 0 0 0 -1\n1 0 0 0 0 -1\n0 1 0 0 0 -1\n3 0 1 2\n", "a.off");
  const std::string p = normals.substr(normals.find("\n0.25 0.25 0.3333333333333333 ") + 1);
  EXPECT_LT(std::stod(p.substr(p.rfind(' ', p.find('\n')))), -0.5) << normals;
}

/// A binary file with normals, and with colours of vertices and faces if `colours`.
std::string binary_off(bool big, bool colours, bool tent) {
  std::string bytes = colours ? "COFF BINARY\n" : "OFF BINARY\n";
  const auto integers = [&](const std::vector<int>& values) {
    for (const int value : values)
      bytes += to_bytes(value, 4, big, false);
  };
  const auto reals = [&](const std::vector<double>& values) {
    for (const double value : values)
      bytes += to_bytes(value, 4, big, true);
  };
  integers({tent ? 6 : 3, tent ? 7 : 1, tent ? 11 : 3});
  reals({0, 0, 0});
  if (colours) reals({1, 0, 0, 1});
  reals({1, 0, 0});
  if (colours) reals({0, 1, 0, 1});
  reals({0, 1, 0});
  if (colours) reals({0, 0, 1, 1});
  if (tent) {
    reals({0.25, 0.25, 1.0 / 3.0});
    if (colours) reals({0.5, 0.25, 0.25, 1});
    reals({0.5, 0.25, 0.25});
    if (colours) reals({0.25, 0.5, 0.25, 1});
    reals({0.25, 0.5, 1.0 / 5.0});
    if (colours) reals({0.25, 0.25, 0.5, 1});
  }
  std::vector<std::vector<int>> faces{{3, 0, 1, 2}};
  if (tent) {
    faces.insert(
        faces.end(),
        {{3, 1, 2, 3}, {3, 2, 0, 3}, {3, 0, 1, 4}, {3, 1, 3, 4}, {3, 3, 0, 4}, {3, 3, 4, 5}});
  }
  for (const std::vector<int>& face : faces) {
    integers(face);
    if (!colours) continue;
    integers({3});
    reals({0.5, 0.25, 0.125});
  }
  return bytes;
}

TEST(ExtendedOff, IsTheBinaryFileThatOneWouldWriteByHand) {
  for (const bool big : {false, true}) {
    for (const bool colours : {false, true}) {
      WriteReport report;
      EXPECT_EQ(with_tent(binary_off(big, colours, false), "a.off", 0, &report),
                binary_off(big, colours, true))
          << big << colours;
      ASSERT_EQ(report.notes.size(), 1U);
      EXPECT_NE(report.notes[0].find("rounded"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace ibmfair::test
