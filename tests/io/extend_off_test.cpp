// An OFF file after an extension has been appended to its vertices and faces.
#include <algorithm>

#include <gtest/gtest.h>

#include "support/extensions.h"
#include "support/mesh_io.h"

namespace ibmfair::test {
namespace {

TEST(ExtendedOff, KeepsToTheLayoutOfTheNumbers) {
  for (const std::string_view text : {
           "OFF\n4 2 5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n",
           "OFF 4 2 5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3",
           "OFF4 2\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3",
           "4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n",
           "#\n\nOFF # a\n#\n4 2 # b\n0 0 0#red\n1 0 0\n#\n1 1 0\n\n0 1 0#\n3 0 1 2#c\n3 0 2 3\n#",
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
    // Without the new rows and with the old counts, the file is the source.
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

TEST(ExtendedOff, StaysOnOneLine) {
  EXPECT_EQ(with_tent("OFF 3 1 0 0 0 0 1 0 0 0 1 0 3 0 1 2", "a.off"),
            "OFF 6 7 0 0 0 0 1 0 0 0 1 0 0.25 0.25 0.3333333333333333 0.5 0.25 0.25 "
            "0.25 0.5 0.2 3 0 1 2 3 1 2 3 3 2 0 3 3 0 1 4 3 1 3 4 3 3 0 4 3 3 4 5");
}

TEST(ExtendedOff, CountsEdgesWhereTheFileDoes) {
  const std::string rows = "\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
  // The tent adds three edges to p, three to q, and two to r.
  EXPECT_TRUE(with_tent("OFF\n4 2 5" + rows, "a.off").starts_with("OFF\n7 8 13\n"));
  EXPECT_TRUE(with_tent("OFF\n4 2 0" + rows, "a.off").starts_with("OFF\n7 8 0\n"));
  EXPECT_TRUE(with_tent("OFF\n4 2" + rows, "a.off").starts_with("OFF\n7 8\n"));
  // An edge count larger than the number of face corners, and the largest number there is, stay.
  EXPECT_TRUE(with_tent("OFF\n4 2 7" + rows, "a.off").starts_with("OFF\n7 8 7\n"));
  const std::string huge = "9223372036854775807";
  EXPECT_TRUE(with_tent("OFF\n4 2 " + huge + rows, "a.off").starts_with("OFF\n7 8 " + huge + "\n"));
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
std::string binary_off_bytes(bool big, bool colours, bool tent) {
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
      EXPECT_EQ(with_tent(binary_off_bytes(big, colours, false), "a.off", 0, &report),
                binary_off_bytes(big, colours, true))
          << big << colours;
      ASSERT_EQ(report.notes.size(), 1U);
      EXPECT_NE(report.notes[0].find("rounded"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace ibmfair::test
