// The text of an OBJ file after an extension has been appended.
#include <gtest/gtest.h>

#include "support/extensions.h"
#include "support/mesh_io.h"

namespace ibmfair::test {
namespace {

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
  // OBJ has no statement that takes faces out of an object.
  ASSERT_EQ(report.notes.size(), 1U);
  EXPECT_NE(report.notes[0].find("6 new faces beside faces without object"), std::string::npos);

  const std::string last = with_tent(groups, "a.obj", 2, &report);
  EXPECT_EQ(last.find('g', groups.size()), std::string::npos) << last;
  EXPECT_TRUE(report.notes.empty());

  const std::string first = with_tent(groups, "a.obj", 0, &report);
  EXPECT_NE(first.find("\ng default\ns off\nf 2 3 5\n"), std::string::npos) << first;
  EXPECT_EQ(report.notes.size(), 2U);  // OBJ has no statement that ends a material either
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

TEST(ExtendedObj, NamesThatEndWithABackslashContinueNothing) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    for (const std::string keyword : {"g", "o", "usemtl"}) {
      // A blank behind the backslash makes the backslash a part of the name; the name is needed
      // again later.
      const std::string text = replaced(
          "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + keyword + " C:\\ \nf 1 2 3\n" + keyword + " b\nf 3 2 1\n",
          "\n", end);
      SCOPED_TRACE(testing::PrintToString(text));
      const std::string out = with_tent(text, "a.obj", 0);
      const MeshFile file = MeshFiles::read(out, "b.obj");
      EXPECT_EQ(file.mesh().faces.size(), 8);
      EXPECT_EQ(file.vertex_mask("C:\\"), (std::vector<std::uint8_t>(6, 1)));
    }
  }
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
        // The new lines have the line end of the file, and only one line end behind each line.
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
  // Vertex 2 has a texture seam; the normals of the second face point to the inside.
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
  // Both vertices of the shared normal are in a face that moves: the normal is dropped.
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
  // The weights of p are 1/2 for the first and 1/4 for the second vertex; those of r are 1/4 and
  // 1/8.
  EXPECT_NE(added.find(" 0.6666666666666666 0.5 0.08333333333333333\n"), std::string::npos)
      << added;
  EXPECT_NE(added.find("vt 0.5 0.25\n"), std::string::npos);
  // A new face has texture coordinates at all of its corners or at none; the face of new vertices
  // has them at all corners.
  EXPECT_NE(added.find("\nf 2 3 5\n"), std::string::npos);
  EXPECT_NE(added.find("\nf 5/2 6/3 7/4\n"), std::string::npos);
}

TEST(ExtendedObj, LooksForTextureInTheFirstFaceWhereTheModelFaceIsFar) {
  MeshFiles files;
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 2 0\nvt 1 1\nvt 2 2\nvt 3 3\nvt 4 4\nvt 5 5\n"
      "f 1/1 2/2 3/3\nf 3/4 4/5 5/1\n";
  const MeshFile file = MeshFiles::read(text, "a.obj");
  Extension extension;
  extension.F = Triangles{{1, 3, 2}, {1, 3, 2}};
  extension.model_face = {1, 0};
  EXPECT_EQ(files.write(file, file.mesh().X, extension, "a.obj"),
            text + "f 2/2 4/5 3/4\nf 2/2 4/5 3/3\n");
}

TEST(ExtendedObj, TakesOnlyThreeOrFourNumbersForAColour) {
  for (const std::string more : {"", " 1", " 1 2", " 1 2 3 4 5"}) {
    std::string text = "v 0 0 0@\nv 1 0 0@\nv 0 1 0@\nf 1 2 3\n";
    text = replaced(text, "@", more);
    EXPECT_NE(with_tent(text, "a.obj").find("\nv 0.25 0.25 0.3333333333333333\n"),
              std::string::npos);
  }
  EXPECT_NE(with_tent(replaced("v 0 0 0@\nv 1 0 0@\nv 0 1 0@\nf 1 2 3\n", "@", " 1 2 3 4"), "a.obj")
                .find("\nv 0.25 0.25 0.3333333333333333 1 2 3 4\n"),
            std::string::npos);
}

}  // namespace
}  // namespace ibmfair::test
