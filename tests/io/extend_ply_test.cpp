// A PLY file after an extension has been appended to its vertices and faces.
#include <array>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "support/extensions.h"
#include "support/mesh_io.h"

namespace ibmfair::test {
namespace {

/// A row of a PLY body: each value with the type in which it is stored.
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

  /// A PLY file with faces first, then an unknown element, and vertices with properties of every
  /// kind.
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

/// A file of four vertices, a quadrilateral and a triangle. With `tent`, a tent over the triangle
/// follows.
std::string ply_file(const PlyText& text, bool tent) {
  std::vector<Row> faces{text.face({0, 1, 2, 3}, -2, true), text.face({3, 1, 0}, 5, true)};
  std::vector<Row> vertices{text.vertex({0, 0, 0.5}, 1, {255, 0, 0}, 11, 0.5),
                            text.vertex({1, 0, 0.5}, 0, {0, 255, 0}, 12, 0.25),
                            text.vertex({1, 1, 0.5}, 2, {1, 2, 3}, 13, 0.125),
                            text.vertex({0, 1, 0.5}, 3, {0, 0, 9}, 14, 1)};
  if (tent) {
    // The corners are 3, 1 and 0. The nearest vertex of p is 1, that of q is 3, and that of r is
    // the same as that of p.
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
        SCOPED_TRACE(testing::PrintToString(std::array{encoding, index, end}));
        WriteReport report;
        EXPECT_EQ(with_tent(ply_file(text, false), "a.ply", 1, &report), ply_file(text, true));
        EXPECT_TRUE(report.notes.empty());
        if (encoding != "ascii") continue;
        // The new rows end with a line end whether or not the last row of the file did.
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
    const WriteOptions exact{.precision = WriteOptions::Precision::float64};
    EXPECT_EQ(with_tent(source, "a.ply", 1, &report, exact),
              ply_file({.encoding = encoding, .real = "double"}, true));
    EXPECT_EQ(report.notes.size(), 1U);
    const WriteOptions keep{.precision = WriteOptions::Precision::keep};
    EXPECT_EQ(with_tent(source, "a.ply", 1, &report, keep), ply_file(single, true));
    EXPECT_TRUE(report.notes.empty());
  }
}

TEST(ExtendedPly, TakesFacesAlone) {
  for (const std::string encoding : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    // An extension of faces only needs neither another type nor a line end behind the vertices.
    const PlyText text{.encoding = encoding, .real = "float", .last_end = false};
    const std::vector<Row> vertices{text.vertex({0, 0, 0.5}, 1, {1, 2, 3}, 11, 0.5),
                                    text.vertex({1, 0, 0.5}, 0, {4, 5, 6}, 12, 0.25),
                                    text.vertex({1, 1, 0.5}, 0, {7, 8, 9}, 13, 0.125)};
    std::vector<Row> faces{text.face({0, 1, 2}, 3, true)};
    MeshFiles files;
    const MeshFile file = MeshFiles::read(text.file(faces, vertices), "a.ply");
    Extension extension;
    extension.F = Triangles{{2, 1, 0}};
    extension.model_face = {0};
    WriteReport report;
    const std::string out = files.write(file, file.mesh().X, extension, "b.ply", {}, &report);
    faces.push_back(text.face({2, 1, 0}, 3, true));
    EXPECT_EQ(out, text.file(faces, vertices));
    EXPECT_TRUE(report.notes.empty());
  }
}

TEST(ExtendedPly, CopiesNormalsInIntegers) {
  // The meaning of integer normals is not known; but if no vertex moves, they need not be dropped.
  const std::string out = with_tent(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty char nx\nproperty char ny\n"
      "property double x\nproperty double y\nproperty double z\nproperty char nz\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 1 0 0 0 100\n0 2 1 0 0 101\n0 3 0 1 0 102\n3 0 1 2\n",
      "a.ply");
  EXPECT_NE(out.find("\n0 3 0 1 0 102\n0 2 0.25 0.25 0.3333333333333333 101\n"
                     "0 1 0.5 0.25 0.25 100\n0 2 0.25 0.5 0.2 101\n3 0 1 2\n"),
            std::string::npos)
      << out;
}

TEST(ExtendedPly, WidensVertexNumbersThatGrowTooLarge) {
  const auto file_of = [](const std::string& encoding, const std::string& index, int vertices) {
    const PlyText text{.encoding = encoding, .index = index};
    std::vector<Row> rows;
    rows.reserve(vertices);
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

}  // namespace
}  // namespace ibmfair::test
