// Writes an OBJ text from the model.
#include "ibmfair/io/atomic_file.h"
#include "ibmfair/io/generate.h"
#include "ibmfair/io/normals.h"
#include "ibmfair/io/numbers.h"
#include "ibmfair/io/obj.h"

namespace ibmfair::obj {
namespace {

void write_row(AtomicFile& out, std::string_view keyword, std::initializer_list<double> values,
               std::string& line) {
  line = keyword;
  for (const double value : values) {
    line += ' ';
    append_real(line, value);
  }
  line += '\n';
  out.write(line);
}

void append_corner(std::string& line, std::int64_t vertex, std::int64_t texture, bool normal) {
  line += ' ';
  append_integer(line, vertex + 1);
  if (texture >= 0 || normal) line += '/';
  if (texture >= 0) append_integer(line, texture + 1);
  if (!normal) return;
  line += '/';
  append_integer(line, vertex + 1);
}

void write_faces(const GenerateRequest& request, AtomicFile& out, std::string& line) {
  const Polygons& faces = request.mesh.faces;
  const MeshAttributes& attributes = request.attributes;
  auto statement = attributes.face_statements.begin();
  for (Index f = 0; f < faces.size(); ++f) {
    for (; statement != attributes.face_statements.end() && statement->first <= f; ++statement) {
      out.write(statement->second);
      out.write("\n");
    }
    line.assign(1, 'f');
    for (std::int64_t i = faces.first[f]; i < faces.first[f + 1]; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const Index texture = attributes.corner_texture.empty() ? -1 : attributes.corner_texture[at];
      append_corner(line, faces.corner[at], texture, attributes.normals);
    }
    line += '\n';
    out.write(line);
  }
}

}  // namespace

std::vector<std::string> generate(const GenerateRequest& request, AtomicFile& out) {
  const Points& X = request.mesh.X;
  const MeshAttributes& attributes = request.attributes;
  std::string line;
  for (Eigen::Index v = 0; v < X.rows(); ++v) {
    if (attributes.colours.empty()) {
      write_row(out, "v", {X(v, 0), X(v, 1), X(v, 2)}, line);
    } else {
      const auto& rgba = attributes.colours[static_cast<std::size_t>(v)];
      write_row(out, "v", {X(v, 0), X(v, 1), X(v, 2), rgba[0], rgba[1], rgba[2]}, line);
    }
  }
  for (const auto& [s, t] : attributes.texture_coordinates)
    write_row(out, "vt", {s, t}, line);
  if (attributes.normals) {
    const Points normals = vertex_normals(request.mesh.faces, X);
    for (Eigen::Index v = 0; v < X.rows(); ++v) {
      write_row(out, "vn", {normals(v, 0), normals(v, 1), normals(v, 2)}, line);
    }
  }
  write_faces(request, out, line);

  std::vector<std::string> left_out = attributes.uncarried;
  if (attributes.opacity) left_out.emplace_back("opacity of the vertex colours");
  return note_left_out("OBJ", std::move(left_out));
}

}  // namespace ibmfair::obj
