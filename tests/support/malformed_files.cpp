#include "support/malformed_files.h"

#include <stdexcept>

#include "support/files.h"
#include "support/hostile_meshes.h"
#include "support/mesh_io.h"

namespace ibmfair::test {
namespace {

using namespace std::string_literals;  // for texts with zero bytes

CommandOutcomes every_command(const Outcome& outcome) {
  CommandOutcomes outcomes;
  for (const std::string& command : outcome_commands()) {
    outcomes[command] = outcome;
  }
  return outcomes;
}

CommandOutcomes refused(const std::string& message) {
  return every_command({3, message});
}

const CommandOutcomes read = every_command({0});

/// The file is read, but not every hole can be filled.
const CommandOutcomes not_filled{{"info", {0}}, {"smooth", {0}}, {"fill", {1}}};

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) {
    all += text;
  }
  return all;
}

/// A mesh of the program's own, in this format.
std::string written(const Mesh& mesh, const std::string& format) {
  const TemporaryDirectory directory;
  write_mesh(mesh, directory / ("mesh." + format));
  return read_bytes(directory / ("mesh." + format));
}

Mesh hostile_mesh(const std::string& name) {
  for (HostileMesh& hostile : hostile_meshes()) {
    if (hostile.name == name) return std::move(hostile.mesh);
  }
  throw std::out_of_range("no hostile mesh is called " + name);
}

std::string utf16(const std::string& text) {
  std::string bytes = "\xFE\xFF";
  for (const char c : text) {
    bytes += {'\0', c};
  }
  return bytes;
}

std::vector<MalformedFile> obj_files() {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  const std::string faces = "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  const std::string pairs = "v 1 0 0\nv 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 1 0\nv 0 0 1\nv 0 -1 -1\n";
  return {
      // Bytes that are no text, or no mesh.
      {"empty.obj", "", refused("the mesh has no vertices")},
      {"comment_only.obj", "# nothing but words\n", refused("the mesh has no vertices")},
      {"zero_byte.obj", corners + "f 1 3\0002\n"s, refused("not an OBJ text (byte 37 is zero)")},
      {"zero_byte_after_huge_number.obj", "v 7E999999999\0 "s,
       refused("not an OBJ text (byte 13 is zero)")},
      {"object_code.obj", "L\1\3\0\x90\x90"s + repeated("\xC3\0"s, 2000),
       refused("not an OBJ text (byte 3 is zero)")},
      {"utf16.obj", utf16(corners + faces), refused("the text is UTF-16; save it as UTF-8")},
      {"points_only.obj", corners, refused("the mesh has no faces")},
      {"lines_only.obj", corners + "l 1 2 3\nl 3 4\n", refused("the mesh has no faces")},
      // Numbers.
      {"huge_number.obj", "v 0 7E999999999 0\n",
       refused("1:5: number too large for double precision in '7E999999999'")},
      {"infinite.obj", "v 0 0 0\nv -Inf nan 0\n", refused("2:3: not a finite number in '-Inf'")},
      {"not_a_number.obj", "v 0 0 NaN\n", refused("1:7: not a finite number in 'NaN'")},
      {"letters.obj", "v 0 0 LL0\n", refused("1:7: not a number in 'LL0'")},
      {"too_few_numbers.obj", "v 0 0\n",
       refused("1:6: a number is missing at the end of the line")},
      {"weights.obj", "v 0 0 0 .5\n" + faces,
       refused("1:9: rational vertices (a weight other than 1) are not supported in '.5'")},
      {"bare_points.obj", "v .0 -.0e+2 +0\nv .1e1 0 0\nv 0 1. 0\nf 1 2 3\n", read},
      {"colours.obj", replaced(corners, " 0\n", " 0 .5 .25 1\n") + faces, read},
      {"colours_not_a_number.obj",
       replaced(corners + faces, "v 1 0 0\n", "v 1 0 0 nan nan nan\r\n"), read},
      // Corners of faces.
      {"no_corners.obj", corners + "f\n" + faces,
       refused("5:1: a face needs at least three corners in 'f'")},
      {"two_corners.obj", corners + faces + "f 1// 2//\n",
       refused("9:1: a face needs at least three corners in 'f'")},
      {"corner_without_vertices.obj", "vt 0 0\nf 1/-1 1/-1 1/-1\n",
       refused("2:3: there is no such vertex (the file has 0) in '1/-1'")},
      {"corner_out_of_range.obj", corners + "f 1 2 5\n",
       refused("5:7: there is no such vertex (the file has 4) in '5'")},
      {"corner_of_letters.obj", corners + "f 1//2 *//1 3//2\n",
       refused("5:8: not a vertex number in '*//1'")},
      {"repeated_corners.obj", corners + faces + "f 1 1 1\nf 1 2 1\nf 2 3 4 4 2\n" + faces, read},
      {"long_face.obj", corners + faces + "f" + repeated(" 1 3 2 4", 300) + "\n", read},
      {"octagon.obj",
       "v 0 1 0\nv 0 2 1\nv 1 3 2\nv 2 3 3\nv 3 2 3\nv 3 1 2\nv 2 0 1\nv 1 0 0\nf 1 2 3 4 5 6 7 "
       "8\n",
       read},
      {"keyhole.obj",  // its ring enters the hole and leaves it along one edge
       "v 0 0 0\nv 9 0 0\nv 9 9 0\nv 0 9 0\nv 3 3 0\nv 3 6 0\nv 6 6 0\nv 6 3 0\n"
       "f 1 2 3 4 1 5 6 7 8 5\n",
       read},
      // Lines.
      {"unknown_lines.obj", corners + "vw 0 1 .5\nt crease 2/1/0 1 3 2.0\n" + faces, read},
      {"no_last_line_end.obj", corners + "g a\r\nusemtl none\r\n" + faces.substr(0, 31), read},
      {"face_in_group_name.obj",
       "v 0 0 0\nv 2 0 0\nv 2 2 0\nf 1 2 3\ng A\tf 1 2 3 Other\n"
       "v -2 0 1\nv 0 -2 1\nf 1 4 5",
       not_filled},
      // Surfaces.
      {"no_area.obj",
       "v 1 2 3\nv 1 2 3\nv 1 2 3\nf 3 2 1\n",
       {{"info", {0}},
        {"smooth", {4, "all edges have the length 0, so that there is nothing to smooth"}},
        {"fill", {1}}}},
      {"isolated_vertices.obj",
       "v 5 5 5\nvn 0 0 1\n" + corners + "f 2 3 4\nf 2 5 3\n" +
           "v 7 7 7\nv 8 7 7\nv 7 8 7\nf 6 7 8\n",
       read},
      {"two_faces_at_a_vertex.obj", corners + "v -1 0 0\nv 0 -1 0\nf 1 2 3\nf 1 5 6\n", not_filled},
      {"two_bodies_at_a_vertex.obj",
       corners + "v -1 0 0\nv 0 -1 0\nv 0 0 -1\n" + faces + "f 1 5 6\nf 1 7 5\nf 1 6 7\nf 5 7 6\n",
       read},
      {"three_faces_at_an_edge.obj", corners + "v 0 -1 -1\nf 1 2 3\nf 1 2 4\nf 1 2 5\n",
       not_filled},
      {"two_bodies_at_a_face.obj",
       corners + "v 1 1 1\n" + faces + "f 4 3 2\nf 2 3 5\nf 3 4 5\nf 4 2 5\n", read},
      {"flipped_duplicates.obj",
       corners + "g quad\nf 4 3 2 1\ng first\nf 4 3 2\ng second\nf 2 4 1\n", read},
      {"coincident_vertices.obj",
       pairs + "f 1 4 6\nf 2 6 7\nf 2 7 5\nf 3 6 4\nf 3 5 7\nf 3 7 6\n"
               "f 1 2 5\nf 1 5 4\nf 1 6 2\nf 3 4 5\n",
       read},
      {"sliver.obj",
       corners + "v .5 1e-9 0\nf 1 3 5\nf 3 2 5\nf 1 5 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n", read},
      {"apart.obj", written(hostile_mesh("5000 components"), "obj"), read},
      {"one_side.obj", written(hostile_mesh("Moebius strip"), "obj"), read},
      {"soup.obj", written(hostile_mesh("soup"), "obj"), not_filled},
  };
}

std::string binary_off() {
  std::string bytes = "OFF BINARY\n";
  const auto integers = [&](const std::vector<int>& numbers) {
    for (const int number : numbers) {
      bytes += to_bytes(number, 4, false, false);
    }
  };
  integers({4, 2, 0});
  for (const double x : {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1}) {
    bytes += to_bytes(x, 4, false, true);
  }
  integers({3, 0, 1, 2, 0, 3, 2, 1, 3, 0});
  return bytes;
}

std::vector<MalformedFile> off_files() {
  const std::string corners = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  const std::string faces = "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  return {
      {"empty.off", "", refused("the file is empty")},
      {"four_dimensions.off", "4OFF\n1 0 0\n0 0 0 0\n",
       refused("1:1: points of other than three dimensions are not supported in '4OFF'")},
      {"other_language.off", "appearance {\n  +texturing\n}\n# OFF\n# 4 4 0\n",
       refused("1:1: not an OFF file: neither a keyword nor counts in 'appearance'")},
      {"huge_count.off", "OFF\n777777777777 4 0\n" + corners + faces,
       refused("2:1: the file is too short for that many vertices: in '777777777777'")},
      {"no_keyword.off",
       "# an index of a colour after each face\n4 4 6\n" + corners + replaced(faces, "\n", "  7\n"),
       read},
      {"keyword_next_to_count.off", "\t   OFF4 4 6 # a comment\n" + corners + faces, read},
      {"comments_everywhere.off",
       "# first\nCOFF # second\n4 4 0\n\n" + replaced(corners, "\n", " 0 .5 1#blue\n\n") +
           replaced(faces, "\n", " 9 9 9 # grey\n"),
       read},
      {"faces_over_lines.off", "OFF\n4 4 0\n" + corners + replaced(faces, " ", "\n\n"), read},
      {"binary.off", binary_off(), read},
      {"binary_cut.off", binary_off().substr(0, 70),
       refused(
           "binary OFF whose rows do not end with the file in either byte order: cut short, or of "
           "an unknown dialect")},
      {"concave_polygon.off", "OFF 6 1 0\n0 0 0 2 0 0 2 2 0 1 2 0 1 1 0 0 1 0\n6 0 1 2 3 4 5\n",
       read},
      {"two_faces_at_a_vertex.off", "OFF 5 2 0\n" + corners + "0 -1 -1\n3 0 1 2 1 1 0\n3\t0 3 4\n",
       not_filled},
      {"mixed_orientation.off", "OFF 4 4 0\n" + corners + replaced(faces, "3 0 2 1", "3 0 1 2"),
       read},
      {"mixed_duplicates.off", "OFF 4 6 0\n" + corners + faces + "3 0 1 2\n3 1 2 3\n", read},
      {"triangle_through_body.off",
       "OFF 7 5 0\n" + corners + ".1 .1 .2\n9 9 .2\n9 9 .3\n" + faces + "3 4 5 6\n", read},
      {"many_faces_at_an_edge.off", written(hostile_mesh("fifty triangles at an edge"), "off"),
       not_filled},
      {"dense_soup.off", written(hostile_mesh("dense soup with repeated corners"), "off"),
       not_filled},
  };
}

/// A binary PLY, little-endian: a tetrahedron with a list of numbers, whose length varies, at each
/// vertex, an unknown element of lists, and bytes after the end.
std::string rich_binary_ply() {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty double x\n"
      "property double y\nproperty double z\nproperty list uchar short tags\nelement edge_data 2\n"
      "property list uint uchar bits\nelement face 4\nproperty list uchar int vertex_indices\n"
      "property list uchar float texcoord\nproperty int number\nend_header\n";
  const auto add = [&](double value, int size, bool real) {
    bytes += to_bytes(value, size, false, real);
  };
  for (int v = 0; v < 4; ++v) {
    for (const int corner : {1, 2, 3}) {
      add(v == corner ? 1 : 0, 8, true);
    }
    add(v, 1, false);
    for (int i = 0; i < v; ++i) {
      add(i, 2, false);
    }
  }
  for (const int count : {1, 3}) {
    add(count, 4, false);
    bytes += repeated("x", count);
  }
  for (const auto& face : {std::array{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
    add(3, 1, false);
    for (const int corner : face) {
      add(corner, 4, false);
    }
    add(1, 1, false);
    add(0.5, 4, true);
    add(7, 4, false);
  }
  return bytes + "\n";
}

/// A tetrahedron in binary, whose first byte after the header is that of `x`.
std::string binary_ply(const std::string& line_end, double x) {
  std::string bytes = replaced(
      "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty double x\n"
      "property double y\nproperty double z\nelement face 4\n"
      "property list uchar uchar vertex_index\nend_header\n",
      "\n", line_end);
  for (const double value : {x, 0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 1.}) {
    bytes += to_bytes(value, 8, false, true);
  }
  return bytes + "\3\0\2\1\3\0\1\3\3\0\3\2\3\1\2\3"s;
}

/// A number near to zero in which the first of eight bytes, the lowest, is `byte`.
double with_first_byte(char byte) {
  return 4.9406564584124654e-324 * byte;
}

std::vector<MalformedFile> ply_files() {
  const std::string start = "ply\nformat ascii 1.0\n";
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  const std::string list = "property list uchar int vertex_indices\n";
  const std::string vertices = "element vertex 4\n" + xyz, end = "end_header\n";
  const std::string corners = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  const std::string faces = "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  const std::string whole = start + vertices + "element face 4\n" + list + end + corners + faces;
  return {
      {"empty.ply", "", refused("1:1: a PLY file starts with 'ply' at the end of the file")},
      {"header_only.ply", start + end, refused("the mesh has no vertices")},
      {"no_rows.ply", start + "element vertex 0\n" + xyz + "element face 0\n" + list + end,
       refused("the mesh has no vertices")},
      {"header_of_zeros.ply", start + "element vertex 4\nproperty float x\nproperty \0"s,
       refused("5:10: unknown type in '?'")},
      {"two_vertex_elements.ply", start + vertices + "element vertex 9\n" + xyz + end + corners,
       refused("7:9: an element may be declared once only in 'vertex'")},
      {"huge_count.ply", replaced(whole, "vertex 4", "vertex 4000000000"),
       refused(
           "3:16: the file is too short for that many rows of 'vertex' (it ends 56 bytes after the "
           "header): in '4000000000'")},
      {"cut.ply", binary_ply("\n", 0).substr(0, 200),
       refused(
           "3:16: the file is too short for that many rows of 'vertex' (it ends 28 bytes after the "
           "header): in '4'")},
      {"points.ply", replaced(start + vertices + end + corners, "\n", "\r\n"),
       refused("the mesh has no faces")},
      {"infinite_points.ply", start + vertices + end + "0 0 +inf\n1 0 -inf\n0 1 0\n0 0 1\n",
       refused("the mesh has no faces")},
      {"infinite.ply", replaced(whole, "1 0 0\n", "1 0 inf\n"),
       refused("11:5: not a finite number in 'inf'")},
      {"points_with_lists.ply",
       start + vertices + "element group 2\nproperty list uchar uint points\nproperty float w\n" +
           end + corners + "3 9 8 7 .5\n1 9 .5\n",
       refused("the mesh has no faces")},
      {"blanks_everywhere.ply",
       replaced(replaced(whole, "element ", "\t element \t "), " 1\n", "\t1 \n"), read},
      {"carriage_returns.ply", replaced(whole, "\n", "\r\n"), read},
      {"face_property.ply",
       start + vertices + "element face 4\n" + list + "property char kind\n" + end + corners +
           replaced(faces, "\n", " 7\n"),
       read},
      {"body_starts_with_line_feed.ply", binary_ply("\n", with_first_byte('\n')), read},
      {"body_starts_with_carriage_return.ply", binary_ply("\r", with_first_byte('\r')), read},
      {"lists_and_unknown_elements.ply", rich_binary_ply(), read},
      {"strips.ply",
       start + vertices + "element tristrips 1\nproperty list int int vertex_indices\n" + end +
           corners + "8 0 1 2 3 -1 3 1 0\n",
       read},
      {"unwelded.ply",
       start + "element vertex 6\n" + xyz + "property float s\nproperty float t\nelement face 2\n" +
           list + end +
           "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n1 0 0 0 0\n0 1 0 1 0\n1 1 0 0 1\n3 0 1 2\n3 3 5 4\n",
       read},
      {"isolated_vertices.ply", written(hostile_mesh("isolated vertices"), "ply"), read},
      {"fins.ply", written(hostile_mesh("fins"), "ply"), read},
      {"nearly_no_edges.ply", written(hostile_mesh("vertices 1e-13 apart"), "ply"), read},
  };
}

/// A binary STL of these triangles, nine coordinates each.
std::string binary_stl(const std::vector<std::vector<double>>& triangles) {
  std::string bytes(80, ' ');
  bytes += to_bytes(static_cast<double>(triangles.size()), 4, false, false);
  for (const std::vector<double>& triangle : triangles) {
    bytes += std::string(12, '\0');  // no normal
    for (const double x : triangle) {
      bytes += to_bytes(x, 4, false, true);
    }
    bytes += std::string(2, '\0');
  }
  return bytes;
}

/// One solid of an ASCII STL, a tetrahedron with its first corner at (x, 0, 0).
std::string solid(const std::string& x, const std::string& x_plus_1, bool flipped) {
  const std::vector<std::string> corner{x + " 0 0", x_plus_1 + " 0 0", x + " 1 0", x + " 0 1"};
  std::string text = "solid s\n";
  for (const auto& [a, b, c] : {std::array{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int v : flipped ? std::array{c, b, a} : std::array{a, b, c}) {
      text += "vertex " + corner[v] + "\n";
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid s\n";
}

std::vector<MalformedFile> stl_files() {
  return {
      // Files that end too early.
      {"truncated.stl",
       binary_stl({{0, 0, 0, 9, 0, 1, 0, 9, 2}, {3, 3, -5, 4, 3, 5, 3, 4, 5}}).substr(0, 170),
       refused("the file is truncated (or no STL): of the 2 triangles that its header announces, 1 "
               "are there (170 of 184 bytes)")},
      {"header_only.stl", binary_stl({{0, 0, 0, 9, 0, 1, 0, 9, 2}}).substr(0, 84),
       refused("the file is truncated (or no STL): of the 1 triangles that its header announces, 0 "
               "are there (84 of 134 bytes)")},
      {"no_header.stl", "something else",
       refused("not an STL file: it neither starts with 'solid' nor has the 84 bytes of a binary "
               "header (it has 14)")},
      {"empty.stl", "", refused("the file is empty")},
      {"within_a_facet.stl", solid("0", "1", false).substr(0, 150),
       refused("9:1: the file is truncated: it ends within the triangle that begins here, after 1 "
               "complete ones")},
      {"no_facets.stl", "solid from nowhere\nendsolid from nowhere\n",
       refused("the mesh has no vertices")},
      {"two_bodies.stl", solid("0", "1", false) + solid("5", "6", true), read},
      {"soup.stl",
       binary_stl({{0, 0, 0, 9, 0, 1, 0, 9, 2},
                   {3, 3, -5, 4, 3, 5, 3, 4, 5},
                   {1, 7, 1, 2, 8, 3, 4, 4, 4}}),
       read},
      {"sliver.stl",
       binary_stl({{0, 0, 0, 1, 0, 0, .5, 1e-6, 0},
                   {1, 0, 0, 0, 0, 0, 0, 0, 1},
                   {0, 0, 0, .5, 1e-6, 0, 0, 0, 1},
                   {.5, 1e-6, 0, 1, 0, 0, 0, 0, 1}}),
       read},
      {"nearly_coincident.stl",
       binary_stl({{0, 0, 0, 1, 0, 0, 0, 1, 0}, {1, 1e-7, 0, 1, 1, 0, 1e-7, 1, 0}}), read},
  };
}

}  // namespace

std::vector<MalformedFile> malformed_files(const std::string& format) {
  if (format == "obj") return obj_files();
  if (format == "off") return off_files();
  if (format == "ply") return ply_files();
  return stl_files();
}

}  // namespace ibmfair::test
