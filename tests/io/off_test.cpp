// OFF in its many variants: text files with and without keyword, prefixes and line breaks, and
// binary files.
#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/io/formats.h"
#include "support/mesh_io.h"

namespace ibmfair::test {
namespace {

const std::vector<Index> two_triangles{0, 1, 2, 0, 2, 3};

TEST(OffFile, AcceptsEveryWayToLayOutNumbers) {
  for (const std::string_view text : {
           "OFF\n4 2 5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n",
           "OFF 4 2 5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3",
           "OFF4 2 5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3",
           "4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n",
           "#\n\nOFF # a\n#\n4 2 # b\n0 0 0#red\n1 0 0\n#\n1 1 0\n\n0 1 0\n3 0 1 2 # c\n3 0 2 3\n#",
           "OFF\r\n4 2 5\r\n0 0 0\r\n1 0 0\r\n1 1 0\r\n0 1 0\r\n3 0 1 2\r\n3 0 2 3\r\n",
           "OFF\r4 2 5\r0 0 0\r1 0 0\r1 1 0\r0 1 0\r3 0 1 2\r3 0 2 3\r",
           "OFF 4 2 5 0 0 0 1 0 0 1 1 0 0 1 0 3 0 1 2 3 0 2 3",
           "OFF\n4 2 5\n0 0 0 1 0 0 1 1 0 0 1 0\n3 0 1 2 3 0 2 3\n",
           "OFF\n4 2 5\n0 0 0\n1 0\n0\n1 1 0\n0 1 0\n3\n0\n1\n2\n\n3 0 2\n3\n",
           "OFF\n4 2 5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 255 0 0\n3 0 2 3  0.1 0.2 0.3 1\n",
           "OFF\n4 2 5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 7\n3 0 2 3 7\n",
       }) {
    SCOPED_TRACE(text);
    const MeshFile file = expect_carried(text, "a.off");
    EXPECT_EQ(file.format().name, "off");
    ASSERT_EQ(file.mesh().X.rows(), 4);
    EXPECT_EQ(file.mesh().X.row(2), Eigen::RowVector3d(1, 1, 0));
    EXPECT_EQ(file.mesh().faces.corner, two_triangles);
  }
}

TEST(OffFile, KeepsWhatFollowsEachPosition) {
  const std::string faces = "3 0 1 2 1 0 0\n";
  for (const std::string& text :
       {"COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 0 255 0 255\n0 1 0 0 0 255 9\n" + faces,
        "COFF\n3 1 0\n0 0 0 0.5 0 0\n1 0 0 0 1 0\n0 1 0 0 0 1\n" + faces,
        "STOFF\n3 1 0\n0 0 0 0.5 0.25\n1 0 0 0 1\n0 1 0 0 0\n" + faces,
        "NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n" + faces,
        "STCNOFF\n3 1 0\n0 0 0 0 0 1 9 9 9 9 .5 .5\n1 0 0 0 0 1 9 9 9 9 0 0\n"
        "0 1 0 0 0 1 9 9 9 9 1 1\n" +
            faces}) {
    SCOPED_TRACE(text);
    const MeshFile file = expect_carried(text, "a.off");
    const std::string keyword = text.substr(0, text.find("OFF"));
    EXPECT_EQ(file.has_normals(), keyword.find('N') != std::string::npos);
    EXPECT_EQ(file.has_texture_coordinates(), keyword.find("ST") != std::string::npos);
    MeshFiles files;
    Points X = file.mesh().X;
    X(1, 0) = 1.5;
    // A move within the plane leaves the values of the normals unchanged, though not their text.
    const std::string out = files.write(file, X, "b.off");
    EXPECT_EQ(different_lines(out, text), std::vector<int>{4});
  }
}

TEST(OffFile, RenewsNormals) {
  MeshFiles files;
  const MeshFile file = MeshFiles::read(
      "CNOFF\n3 1 0\n0 0 0 0 0 1 9 9 9 9\n1 0 0 0 0 1 9 9 9 9\n0 1 0 0 0 -1 9 9 9 9\n3 0 1 2\n",
      "a.off");
  Points X = file.mesh().X;
  X.row(1) << 0, 0, 2;
  EXPECT_EQ(
      files.write(file, X, "b.off"),
      "CNOFF\n3 1 0\n0 0 0 -1 0 0 9 9 9 9\n0 0 2 -1 0 0 9 9 9 9\n0 1 0 1 -0 -0 9 9 9 9\n3 0 1 2\n");
}

std::string binary_off(bool big, bool colour_counts, const std::string& prefix = "") {
  std::string bytes = prefix + "OFF BINARY\n";
  for (const int count : {4, 2, 0})
    bytes += to_bytes(count, 4, big, false);
  for (int v = 0; v < 4; ++v) {
    for (const double x : {v % 2 + 0.5, v < 2 ? 0.0 : 1.0, 3.0}) {
      bytes += to_bytes(x, 4, big, true);
    }
    for (int c = 0; c < 3 && prefix == "N"; ++c)
      bytes += to_bytes(c == 2, 4, big, true);
  }
  for (const auto& face : {std::vector<int>{3, 0, 1, 2}, std::vector<int>{4, 0, 1, 3, 2}}) {
    for (const int value : face)
      bytes += to_bytes(value, 4, big, false);
    if (colour_counts) bytes += to_bytes(1, 4, big, false) + to_bytes(0.5, 4, big, true);
  }
  return bytes;
}

TEST(OffFile, ReadsBinaryDialectsAndKeepsThem) {
  for (const bool big : {false, true}) {
    for (const bool colour_counts : {false, true}) {
      for (const char* prefix : {"", "N"}) {
        const std::string bytes = binary_off(big, colour_counts, prefix);
        MeshFiles files;
        const MeshFile file = MeshFiles::read(bytes, "a.off");
        EXPECT_EQ(file.mesh().X.row(3), Eigen::RowVector3d(1.5, 1, 3));
        EXPECT_EQ(file.mesh().faces.corner, (std::vector<Index>{0, 1, 2, 0, 1, 3, 2}));
        EXPECT_EQ(files.write(file, file.mesh().X, "b.off"), bytes);
        Points X = file.mesh().X;
        X(3, 0) = -0.25;
        EXPECT_EQ(files.write(file, X, "b.off").size(), bytes.size());
        EXPECT_EQ(read_mesh(files.path("b.off")).mesh().X, X);
      }
      const std::string bytes = binary_off(big, colour_counts);
      for (std::size_t size = 0; size < bytes.size(); ++size) {
        EXPECT_NE(read_error(bytes.substr(0, size), "a.off"), "");
      }
    }
  }
}

TEST(OffFile, RefusesWithLineColumnAndWord) {
  const auto refused = [](const std::string& text) { return read_error(text, "a.off"); };
  const std::string start = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_EQ(refused(""), "a.off: the file is empty");
  EXPECT_EQ(refused("solid\n"),
            "a.off:1:1: not an OFF file: neither a keyword nor counts in 'solid'");
  EXPECT_EQ(refused("4OFF\n1 1 0\n"),
            "a.off:1:1: points of other than three dimensions are not supported in '4OFF'");
  EXPECT_EQ(refused("OFF\n4000000000 1 0\n0 0 0\n"),
            "a.off:2:1: the file is too short for that many vertices: in '4000000000'");
  EXPECT_EQ(refused("OFF\n1 -1 0\n0 0 0\n"), "a.off:2:3: a negative number of faces in '-1'");
  EXPECT_EQ(refused(start + "3 0 1 3\n"),
            "a.off:6:7: there is no such vertex (the file has 3, counted from 0) in '3'");
  EXPECT_EQ(refused(start + "3 0 -1 2\n"),
            "a.off:6:5: there is no such vertex (the file has 3, counted from 0) in '-1'");
  EXPECT_EQ(refused(start + "2 0 1   \n"), "a.off:6:1: a face needs at least three corners in '2'");
  EXPECT_EQ(refused(start + "9 0 1 2 \n"), "a.off:6:1: the file ends before the face does in '9'");
  EXPECT_EQ(refused(start + "3 0 1    \n"),
            "a.off:7:1: the file ends before its last row does at the end of the file");
  EXPECT_EQ(refused("OFF\n3 1 0\n0 0 x\n1 0 0\n0 1 0\n3 0 1 2\n"),
            "a.off:3:5: not a number in 'x'");
  EXPECT_EQ(refused("OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n"), "a.off: the mesh has no faces");
}

TEST(OffFile, RefusesEveryTruncation) {
  const std::string text = "COFF\n3 2 0\n0 0 0 1 0 0\n1 0 0 1 0 0\n0 1 0 1 0 0\n3 0 1 2\n3 2 1 0\n";
  for (std::size_t size = 0; size < text.size() - 2; ++size) {
    EXPECT_NE(read_error(text.substr(0, size), "a.off"), "") << size;
  }
}

}  // namespace
}  // namespace ibmfair::test
