// PLY: files are written back as they were read in all three encodings, and files that cannot be
// read are refused before anything is allocated for them.
#include <array>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/io/formats.h"
#include "support/mesh_io.h"

namespace ibmfair::test {
namespace {

constexpr std::string_view with_everything =
    "ply\nformat ascii 1.0\ncomment made by hand\nobj_info none\n"
    "element vertex 4\nproperty uchar red\nproperty double x\nproperty double y\n"
    "property float quality\nproperty double z\nproperty int label\n"
    "element face 2\nproperty list uchar int vertex_index\nproperty uchar flag\n"
    "property list uchar float texcoord\n"
    "element edge 1\nproperty int vertex1\nproperty int vertex2\n"
    "end_header\n"
    "255 0 0 0.5 0 1\n1 1 0.125  0.5 0 0\n2 1 1 nan 0 0\n3 0 1 0.5\t0 7 \n"
    "3 0 1 2 9 6 0 0 1 0 1 1\n3 0 2 3 8 0\n"
    "0 1\n";

TEST(PlyFile, KeepsUnknownElementsAndProperties) {
  const MeshFile file = expect_carried(with_everything, "a.ply");
  EXPECT_EQ(file.format().name, "ply");
  EXPECT_TRUE(file.has_texture_coordinates());
  EXPECT_FALSE(file.has_normals());
  EXPECT_EQ(file.mesh().X.row(1), Eigen::RowVector3d(1, 0.125, 0));
  EXPECT_EQ(file.mesh().faces.corner, (std::vector<Index>{0, 1, 2, 0, 2, 3}));

  MeshFiles files;
  Points X = file.mesh().X;
  X(1, 1) = 0.25;
  const std::string out = files.write(file, X, "b.ply");
  EXPECT_EQ(different_lines(out, with_everything), std::vector<int>{21});
  EXPECT_NE(out.find("\n1 1 0.25  0.5 0 0\n"), std::string::npos);
}

TEST(PlyFile, SelectsVerticesByProperty) {
  MeshFiles files;
  const MeshFile file = MeshFiles::read(with_everything, "a.ply");
  EXPECT_EQ(file.vertex_mask("label"), (std::vector<std::uint8_t>{1, 0, 0, 1}));
  EXPECT_THROW(file.vertex_mask("flag"), BadOption);
}

struct Numbers {
  std::string type;
  int size;
  bool real;
};

/// A binary file. Its faces have a list of bytes behind them; an unknown element follows; its
/// vertices have a list between y and z; there are a few bytes after the end.
std::string binary_ply(bool big, const Numbers& number, const Numbers& count, const Numbers& index,
                       const std::string& line_end = "\n") {
  std::string text;
  for (const std::string& line :
       {"ply" + std::string(),
        std::string("format binary_") + (big ? "big" : "little") + "_endian 1.0",
        std::string("element face 2"),
        "property list " + count.type + " " + index.type + " vertex_indices",
        std::string("property short flag"), std::string("element other 2"),
        std::string("property list uint double values"), std::string("element vertex 4"),
        "property " + number.type + " z", std::string("property list uchar ushort tags"),
        "property " + number.type + " x", std::string("property double y"),
        std::string("end_header")}) {
    text += line + line_end;
  }
  for (const auto& face : {std::vector<int>{0, 1, 2, 3}, std::vector<int>{3, 1, 0}}) {
    text += to_bytes(static_cast<double>(face.size()), count.size, big, false);
    for (const int v : face)
      text += to_bytes(v, index.size, big, false);
    text += to_bytes(-2, 2, big, false);
  }
  text += to_bytes(0, 4, big, false) + to_bytes(1, 4, big, false) + to_bytes(0.1, 8, big, true);
  for (int v = 0; v < 4; ++v) {
    text += to_bytes(10 + v, number.size, big, number.real) + to_bytes(v, 1, big, false);
    for (int i = 0; i < v; ++i)
      text += to_bytes(i, 2, big, false);
    text += to_bytes(v % 2, number.size, big, number.real) + to_bytes(0.1 * v, 8, big, true);
  }
  return text + "\r\n ";
}

TEST(PlyFile, ReadsEveryBinaryLayout) {
  const std::vector<Numbers> reals{{"float", 4, true},
                                   {"float64", 8, true},
                                   {"char", 1, false},
                                   {"uint16", 2, false},
                                   {"int", 4, false}};
  const std::vector<Numbers> counts{
      {"uchar", 1, false}, {"int8", 1, false}, {"short", 2, false}, {"uint", 4, false}};
  const std::vector<Numbers> indices{
      {"uchar", 1, false}, {"short", 2, false}, {"uint32", 4, false}, {"int", 4, false}};
  const auto check = [](bool big, const Numbers& real, const Numbers& count, const Numbers& index) {
    SCOPED_TRACE(real.type + " " + count.type + " " + index.type + (big ? " big" : " little"));
    const MeshFile file = expect_carried(binary_ply(big, real, count, index), "a.ply");
    ASSERT_EQ(file.mesh().X.rows(), 4);
    EXPECT_EQ(file.mesh().X.row(3), Eigen::RowVector3d(1, 0.1 * 3, 13));
    EXPECT_EQ(file.mesh().faces.corner, (std::vector<Index>{0, 1, 2, 3, 3, 1, 0}));
  };
  for (const bool big : {false, true}) {
    for (const Numbers& real : reals)
      check(big, real, counts[0], indices[3]);
    for (const Numbers& count : counts)
      check(big, reals[0], count, indices[1]);
    for (const Numbers& index : indices)
      check(big, reals[1], counts[3], index);
  }
}

TEST(PlyFile, HeadersMayEndTheirLinesInAnyWay) {
  const Numbers real{"double", 8, true};
  const Numbers count{"uchar", 1, false};
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    // 10 and 13 as first data bytes must not be taken for the end of the header.
    for (const char first : {'\n', '\r'}) {
      std::string bytes = fmt::format(
          "ply{0}format binary_little_endian 1.0{0}element lead 1{0}property char c{0}"
          "element vertex 3{0}property float x{0}property float y{0} property\tfloat  z{0}"
          "element face 1{0}property list uchar uchar vertex_indices{0}end_header{0}{1}",
          end, first);
      for (const double x : {0, 0, 0, 1, 0, 0, 0, 1, 0})
        bytes += to_bytes(x, 4, false, true);
      bytes += std::string("\3\0\1\2", 4);
      SCOPED_TRACE(testing::PrintToString(bytes));
      EXPECT_EQ(expect_carried(bytes, "a.ply").mesh().X(1, 0), 1.0);
    }
  }
}

constexpr std::string_view float_triangle =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float32 y\n"
    "property int z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0.1 0\n1 0 0\n0 1 0\n3 0 1 2\n";

TEST(PlyFile, DeclaresDoubleWhereAsked) {
  MeshFiles files;
  const MeshFile file = MeshFiles::read(float_triangle, "a.ply");
  EXPECT_EQ(file.mesh().X(0, 1), 0.1);
  EXPECT_EQ(files.write(file, file.mesh().X, "b.ply"), float_triangle);
  const WriteOptions exact{.precision = WriteOptions::Precision::float64};
  EXPECT_EQ(different_lines(files.write(file, file.mesh().X, "b.ply", exact), float_triangle),
            (std::vector<int>{4, 5, 6}));
  Points X = file.mesh().X;
  X.row(1) << 1.0 / 3.0, 0, 0.1;
  WriteReport report;
  const std::string out = files.write(file, X, "b.ply", exact, &report);
  EXPECT_EQ(different_lines(out, float_triangle), (std::vector<int>{4, 5, 6, 11}));
  EXPECT_NE(out.find("property double x\nproperty float64 y\nproperty double z\n"),
            std::string::npos);
  EXPECT_NE(out.find("\n0.3333333333333333 0 0.1\n"), std::string::npos);
  EXPECT_EQ(report.notes.size(), 1U);
}

TEST(PlyFile, KeepsFloats) {
  MeshFiles files;
  const WriteOptions keep{.precision = WriteOptions::Precision::keep};
  const MeshFile text = MeshFiles::read(float_triangle, "a.ply");
  Points X = text.mesh().X;
  X(1, 0) = 1.0 / 3.0;
  const std::string out = files.write(text, X, "b.ply", keep);
  EXPECT_EQ(different_lines(out, float_triangle), (std::vector<int>{6, 11}));
  EXPECT_NE(out.find("\n0.33333334 0 0\n"), std::string::npos);

  const Numbers byte{"uchar", 1, false};
  const std::string bytes = binary_ply(true, {"float", 4, true}, byte, byte);
  const MeshFile binary = MeshFiles::read(bytes, "a.ply");
  X = binary.mesh().X;
  X(1, 0) = 1.0 / 3.0;
  EXPECT_EQ(files.write(binary, X, "b.ply", keep).size(), bytes.size());
  EXPECT_EQ(read_mesh(files.path("b.ply")).mesh().X(1, 0), static_cast<double>(1.0F / 3.0F));
}

TEST(PlyFile, RenewsNormals) {
  MeshFiles files;
  constexpr std::string_view text =
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty double x\nproperty double y\n"
      "property double z\nproperty float nx\nproperty float ny\nproperty float nz\n"
      "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 -3\n5 0 0 1 2 3\n6 0 0 1 2 3\n5 1 0 1 2 3\n"
      "3 0 1 2\n3 3 4 5\n";
  const MeshFile file = expect_carried(text, "a.ply");
  EXPECT_TRUE(file.has_normals());
  Points X = file.mesh().X;
  X(1, 2) = 1.0;
  const std::string out = files.write(file, X, "b.ply");
  EXPECT_EQ(different_lines(out, text), (std::vector<int>{13, 14, 15}));
  EXPECT_NE(out.find("\n0 0 0 -0.70710677 0 0.70710677\n"), std::string::npos) << out;
  EXPECT_NE(out.find("\n0 1 0 0.70710677 -0 -0.70710677\n"), std::string::npos) << out;
}

TEST(PlyFile, DropsNormalsInIntegers) {
  MeshFiles files;
  const MeshFile file = MeshFiles::read(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty char nx\nproperty char ny\n"
      "property double x\nproperty double y\nproperty double z\nproperty char nz\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0 0 0 127\n0 0 1 0 0 127\n0 0 0 1 0 127\n3 0 1 2\n",
      "a.ply");
  Points X = file.mesh().X;
  X(0, 2) = 4;
  WriteReport report;
  files.write(file, X, "b.ply", {}, &report);
  EXPECT_EQ(report.notes.size(), 1U);
  const MeshFile again = read_mesh(files.path("b.ply"));
  EXPECT_FALSE(again.has_normals());
  EXPECT_EQ(again.mesh().X, X);
}

TEST(PlyFile, ReadsTriangleStrips) {
  const MeshFile file = expect_carried(
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty double x\nproperty double y\n"
      "property double z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n9 0 1 2 3 4 4 -1 4 3\n",
      "a.ply");
  EXPECT_EQ(file.mesh().faces.corner, (std::vector<Index>{0, 1, 2, 2, 1, 3, 2, 3, 4}));
}

std::string ascii(const std::string& elements, const std::string& body) {
  return "ply\nformat ascii 1.0\n" + elements + "end_header\n" + body;
}

const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
const std::string list = "property list uchar int vertex_indices\n";

TEST(PlyFile, RefusesBadHeaders) {
  const auto refused = [](const std::string& text) { return read_error(text, "a.ply"); };
  EXPECT_EQ(refused(""), "a.ply:1:1: a PLY file starts with 'ply' at the end of the file");
  EXPECT_EQ(refused("plyx\n"), "a.ply:1:1: a PLY file starts with 'ply' in 'plyx'");
  EXPECT_EQ(refused("ply\nformat ascii 1.0\nelement vertex 3\n"),
            "a.ply:4:1: the header has no 'end_header' at the end of the file");
  EXPECT_EQ(refused("ply\nformat text 1.0\n"), "a.ply:2:8: unknown format in 'text'");
  EXPECT_EQ(refused(ascii("element vertex -1\n" + xyz, "")),
            "a.ply:3:16: the element's count is negative in '-1'");
  EXPECT_EQ(refused(ascii("element vertex 3.5\n" + xyz, "")),
            "a.ply:3:16: the element's count is not an integer in '3.5'");
  EXPECT_NE(refused(ascii("element vertex 4000000000\n" + xyz, "0 0 0\n"))
                .find("a.ply:3:16: the file is too short for that many rows of 'vertex'"),
            std::string::npos);
  EXPECT_NE(refused(ascii("element vertex 99999999999999999999999\n" + xyz, "0 0 0\n"))
                .find("a.ply:3:16: the file is too short"),
            std::string::npos);
  EXPECT_NE(refused("ply\nformat binary_little_endian 1.0\nelement vertex 1\n" + xyz +
                    "element face 4000000000\n" + list + "end_header\n0123456789ab")
                .find("a.ply:7:14: the file is too short"),
            std::string::npos);
  EXPECT_EQ(refused(ascii("element vertex 3\n" + xyz + "element vertex 3\n" + xyz, "")),
            "a.ply:7:9: an element may be declared once only in 'vertex'");
  EXPECT_EQ(refused(ascii("element vertex 3\nproperty half x\n", "")),
            "a.ply:4:10: unknown type in 'half'");
  EXPECT_EQ(refused(ascii("element vertex 3\n" + xyz + "propperty float w\n", "")),
            "a.ply:7:1: unknown header line in 'propperty'");
  EXPECT_EQ(refused(ascii("element vertex 1\nproperty float x\nproperty float z\n", "0 0\n")),
            "a.ply:3:16: the vertices have no scalar properties x, y and z; in '1'");
  EXPECT_EQ(refused(ascii("element vertex 1\n" + xyz + "property float x\n", "0 0 0 0\n")),
            "a.ply:7:1: 'vertex' has two properties 'x': in 'property'");
  EXPECT_EQ(refused(ascii("element vertex 1\n" + xyz +
                              "element face 1\nproperty list float int "
                              "vertex_indices\n",
                          "0 0 0\n3 0 0 0\n")),
            "a.ply:8:15: the count of a list must be an integer in 'float'");
}

TEST(PlyFile, RefusesToSelectByOneOfTwoPropertiesOfAName) {
  const MeshFile file = MeshFiles::read(
      ascii("element vertex 3\n" + xyz + "property uchar part\nproperty uchar part\n" +
                "element face 1\n" + list,
            "0 0 0 1 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n"),
      "a.ply");
  try {
    file.vertex_mask("part");
    FAIL() << "read without a word";
  } catch (const BadFile& error) {
    EXPECT_STREQ(error.what(), "a.ply:8:1: 'vertex' has two properties 'part': in 'property'");
  }
}

TEST(PlyFile, RefusesWhatHasNoFaces) {
  const auto refused = [](const std::string& text) { return read_error(text, "a.ply"); };
  EXPECT_EQ(refused(ascii("element vertex 1\n" + xyz, "0 0 0\n")), "a.ply: the mesh has no faces");
  EXPECT_EQ(refused(ascii("element vertex 1\n" + xyz + "element face 0\n" + list, "0 0 0\n")),
            "a.ply: the mesh has no faces");
  EXPECT_EQ(refused("ply\nformat ascii 1.0\nend_header\n"), "a.ply: the mesh has no vertices");
}

TEST(PlyFile, RefusesBadRows) {
  const std::string start = "element vertex 3\n" + xyz + "element face 1\n" + list;
  const auto refused = [&](const std::string& body) {
    return read_error(ascii(start, body), "a.ply");
  };
  EXPECT_EQ(refused("0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
            "a.ply:13:7: there is no vertex 3 (the file has 3, counted from 0) in '3'");
  EXPECT_EQ(refused("0 0 0\n1 0 0\n0 1 0\n3 0 -1 2\n"),
            "a.ply:13:5: there is no vertex -1 (the file has 3, counted from 0) in '-1'");
  EXPECT_EQ(refused("0 0 0\n1 0 0 9\n0 1 0\n3 0 1 2\n"),
            "a.ply:11:7: the row has more values than the header declares in '9'");
  EXPECT_EQ(refused("0 0 0\n1 0\n0 1 0\n3 0 1 2\n").substr(0, 11), "a.ply:12:3:");
  EXPECT_EQ(refused("0 0 0\n1 0 x\n0 1 0\n3 0 1 2\n"), "a.ply:11:5: not a number in 'x'");
  EXPECT_EQ(refused("0 0 0\n1 0 inf\n0 1 0\n3 0 1 2\n"),
            "a.ply:11:5: not a finite number in 'inf'");
  EXPECT_EQ(refused("0 0 0\n1 0 0\n0 1 0\n2 0 1\n"),
            "a.ply:13:3: a face needs at least three corners in '0'");
  EXPECT_EQ(refused("0 0 0\n1 0 0\n0 1 0\n999999 0 1\n"),
            "a.ply:13:1: the file ends before the list does in '999999'");

  const Numbers byte{"uchar", 1, false};
  std::string bytes = binary_ply(false, {"float", 4, true}, byte, byte);
  const std::size_t body = bytes.find("end_header\n") + 11;
  bytes[body + 2] = 9;
  EXPECT_EQ(read_error(bytes, "a.ply"),
            "a.ply: face 0 (byte " + std::to_string(body + 2) +
                "): there is no vertex 9 (the file has 4, counted from 0)");
}

TEST(PlyFile, RefusesEveryTruncation) {
  const Numbers byte{"uchar", 1, false};
  const std::string binary = binary_ply(false, {"float", 4, true}, {"int", 4, false}, byte);
  const std::string text(with_everything);
  // Blanks after the end and the last line end are not needed; the digits of the last number are.
  const std::size_t last_needed = binary.size() - 3;
  for (std::size_t size = 0; size < last_needed; ++size) {
    EXPECT_NE(read_error(binary.substr(0, size), "a.ply"), "");
  }
  for (std::size_t size = 0; size < text.size() - 2; ++size) {
    EXPECT_NE(read_error(text.substr(0, size), "a.ply"), "");
  }
  for (const std::size_t size : {last_needed, binary.size()}) {
    EXPECT_EQ(MeshFiles::read(binary.substr(0, size), "a.ply").mesh().X.rows(), 4);
  }
}

TEST(PlyFile, SurvivesEveryChangedByte) {
  const Numbers byte{"uchar", 1, false};
  const std::string whole = binary_ply(false, {"float", 4, true}, {"int", 4, false}, byte);
  MeshFiles files;
  int read = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    for (const char change : {'\0', '\x7F', '\xFF', '9'}) {
      std::string bytes = whole;
      bytes[i] = change;
      try {
        const MeshFile file = MeshFiles::read(bytes, "a.ply");
        write_mesh(file, mostly_moved(file.mesh().X), "/dev/null", {.format = "ply"});
        ++read;
      } catch (const BadFile& error) {
        EXPECT_NE(std::string(error.what()), "");
      }
    }
  }
  EXPECT_GT(read, 100);
}

}  // namespace
}  // namespace ibmfair::test
