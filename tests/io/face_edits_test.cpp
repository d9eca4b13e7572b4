// Replacing single faces of a file: everything else stays as it is.
#include "ibmfair/io/face_edits.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "ibmfair/io/source_bytes.h"
#include "support/files.h"
#include "support/mesh_io.h"

namespace ibmfair::test {
namespace {

/// Two triangles 0 1 2 and 0 2 3, and vertex 4 a quarter of the way from vertex 0 to vertex 2.
const std::vector<FaceEdit> quarter{{0,
                                     {{{4, 2, 0, 0.75}, {0, 0, 0, 0}, {1, 1, 1, 0}},
                                      {{1, 1, 1, 0}, {2, 2, 2, 0}, {4, 2, 0, 0.75}}}}};

std::string edited(const std::string& text, const std::string& name, bool without_notes = true) {
  const MeshFile file = MeshFiles::read(text, name);
  const EditedFile result = edit_faces(file, quarter);
  EXPECT_EQ(result.notes.empty(), without_notes);
  EXPECT_EQ(result.file.mesh().X, file.mesh().X);
  const Mesh wanted = with_edited_faces(file.mesh(), quarter);
  EXPECT_EQ(result.file.mesh().faces.corner, wanted.faces.corner);
  EXPECT_EQ(result.file.mesh().faces.first, wanted.faces.first);
  return std::string(result.file.bytes().view());
}

TEST(FaceEdits, AnObjKeepsItsTextAndInterpolatesTexture) {
  const std::string vertices =
      "# a comment\r\nmtllib a.mtl\r\nv 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\nv .25 .25 0\r\n"
      "vt 0 0\r\nvt 1 0\r\nvt 1 .5\r\nvn 0 0 1\r\nvn 0 1 0\r\n";
  const std::string end = " # first\r\nusemtl b\r\nf 1 3 4\r\nl 1 2\r\n";
  EXPECT_EQ(edited(vertices + "usemtl a\r\nf 1/1/1 2/2/1 3/3/2" + end, "a.obj"),
            vertices +
                "usemtl a\r\nvt 0.25 0.125\r\nvn 0 0.31622776601683794 0.9486832980505138\r\n"
                "f 5/4/3 1/1/1 2/2/1\r\nf 2/2/1 3/3/2 5/4/3" +
                end);
  // One texture coordinate at both corners is that of the new corner, too. Relative numbers stay.
  EXPECT_EQ(edited(vertices + "f -5/-3 -4/-2 -3/1" + end, "a.obj"),
            vertices + "f 5/1 -5/-3 -4/-2\r\nf -4/-2 -3/1 5/1" + end);
  EXPECT_EQ(edited(vertices + "f 1//1 2 3//1" + end, "a.obj"),
            vertices + "f 5//1 1//1 2\r\nf 2 3//1 5//1" + end);
  EXPECT_EQ(edited(vertices + "f 1 \\\r\n 2 3" + end, "a.obj"),
            vertices + "f 5 1 2\r\nf 2 3 5" + end);
}

TEST(FaceEdits, AnObjWhoseNumbersWouldChangeIsGenerated) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .25 .25 0\n";
  const std::string texture = "# a\nvt 0 0\nvt 1 0\nvt 1 .5\n";
  for (const std::string& faces : {std::string("f 1/-3 2/-2 3/-1\nf 1 3 4\n"),
                                   std::string("f 1/1 2/2 3/3\nvt 0 0\nf 1 3 4/4\n"),
                                   std::string("f 1/1 2/2 3/3\nf 1/-3 3 4\n")}) {
    const std::string text = edited(vertices + texture + faces, "a.obj", false);
    EXPECT_NE(text.find("vt 0.25 0.125\n"), std::string::npos) << text;
  }
}

TEST(FaceEdits, AnOffKeepsItsTextAndColours) {
  const std::string vertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n.25 .25 0 # last\n";
  EXPECT_EQ(edited("OFF\n5 2 5\n" + vertices + "\n3 0 1 2  255 0 0 # red\n3 0 2 3\n", "a.off"),
            "OFF\n5 3 8\n" + vertices + "\n3 4 0 1 255 0 0\n3 1 2 4 255 0 0 # red\n3 0 2 3\n");
  EXPECT_EQ(edited("OFF 5 2 0 " + vertices + "3 0 1 2 3 0 2 3", "a.off"),
            "OFF 5 3 0 " + vertices + "3 4 0 1 3 1 2 4 3 0 2 3");
}

std::string words_of(std::initializer_list<int> words) {
  std::string bytes;
  for (const int word : words)
    bytes += to_bytes(word, 4, true, false);
  return bytes;
}

TEST(FaceEdits, ABinaryOffKeepsItsBytes) {
  std::string vertices;
  for (const double x : {0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0., .25, .25, 0.})
    vertices += to_bytes(x, 4, true, true);
  const std::string colour = words_of({1, 7}), none = words_of({0});
  EXPECT_EQ(edited("OFF BINARY\n" + words_of({5, 2, 0}) + vertices + words_of({3, 0, 1, 2}) +
                       colour + words_of({3, 0, 2, 3}) + none,
                   "a.off"),
            "OFF BINARY\n" + words_of({5, 3, 0}) + vertices + words_of({3, 4, 0, 1}) + colour +
                words_of({3, 1, 2, 4}) + colour + words_of({3, 0, 2, 3}) + none);
}

TEST(FaceEdits, APlyKeepsItsTextAndProperties) {
  const std::string header =
      "ply\nformat ascii 1.0\ncomment here\nelement vertex 5\nproperty float x\nproperty float y\n"
      "property float z\nelement face ";
  const std::string rest =
      "\nproperty uchar material\nproperty list uchar int vertex_indices\n"
      "property list uchar float texcoord\nelement note 1\nproperty int n\nend_header\n"
      "0 0 0\n1 0 0\n1 1 0\n0 1 0\n.25 .25 0\n";
  const std::string end = "2 3 0 2 3 0\n77\n";
  EXPECT_EQ(edited(header + "2" + rest + "9 3 0 1 2 6 0 0 1 0 1 .5\n" + end, "a.ply"),
            header + "3" + rest +
                "9 3 4 0 1 6 0.25 0.125 0 0 1 0\n9 3 1 2 4 6 1 0 1 0.5 0.25 0.125\n" + end);
}

/// Strips are written as faces, and text that declares float may hold other numbers.
TEST(FaceEdits, APlyOfStripsKeepsItsNumbers) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
      "property float z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n";
  for (const std::string number : {"1.5", "0.1", "1e99"}) {
    SCOPED_TRACE(number);
    const std::string text =
        edited(header + number + " 1 0\n0 1 0\n.25 .25 0\n4 0 1 2 3\n", "a.ply", number != "1.5");
    EXPECT_EQ(text.find("property float x") != std::string::npos, number == "1.5");
  }
}

/// In files of other programs, the lines of other faces stay as they are.
TEST(FaceEdits, ForeignFilesKeepTheirLines) {
  for (const std::string& path : project_meshes()) {
    SCOPED_TRACE(path);
    const MeshFile file = read_mesh(path);
    std::vector<FaceEdit> edits;
    for (Index f = 0; f < file.mesh().faces.size(); f += 100) {
      FaceEdit& edit = edits.emplace_back(FaceEdit{f, {{}}});
      for (Index i = 0; i < std::ssize(file.mesh().faces[f]); ++i)
        edit.pieces.front().push_back({file.mesh().faces[f][i], i, i, 0});
    }
    const EditedFile same = edit_faces(file, edits);
    EXPECT_EQ(same.file.mesh().X, file.mesh().X);
    EXPECT_EQ(same.file.mesh().faces.corner, file.mesh().faces.corner);
    const std::vector<int> different =
        different_lines(same.file.bytes().view(), file.bytes().view());
    EXPECT_LE(different.size(), edits.size());
    EXPECT_EQ(std::ranges::count(different, -1), 0);
  }
}

}  // namespace
}  // namespace ibmfair::test
