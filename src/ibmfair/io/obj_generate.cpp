// Generates an OBJ text from the mesh and its attributes.
#include "ibmfair/io/byte_sink.h"
#include "ibmfair/io/generate.h"
#include "ibmfair/io/normals.h"
#include "ibmfair/io/obj.h"
#include "ibmfair/io/obj_lines.h"

namespace ibmfair::obj {
namespace {

void write_faces(const GenerateRequest& request, ObjLines& lines) {
  const Polygons& faces = request.mesh.faces;
  const MeshAttributes& attributes = request.attributes;
  auto statement = attributes.face_statements.begin();
  for (Index f = 0; f < faces.size(); ++f) {
    for (; statement != attributes.face_statements.end() && statement->first <= f; ++statement) {
      lines.statement(statement->second);
    }
    lines.begin_face();
    for (std::int64_t i = faces.first[f]; i < faces.first[f + 1]; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const Index texture = attributes.corner_texture.empty() ? -1 : attributes.corner_texture[at];
      const Index vertex = faces.corner[at];
      lines.corner({vertex, texture, attributes.normals ? vertex : -1});
    }
    lines.end_face();
  }
}

}  // namespace

std::vector<std::string> generate(const GenerateRequest& request, ByteSink& out) {
  const Points& X = request.mesh.X;
  const MeshAttributes& attributes = request.attributes;
  ObjLines lines(out, "\n");
  for (Eigen::Index v = 0; v < X.rows(); ++v) {
    if (attributes.colours.empty()) {
      lines.row("v", {X.row(v).data(), 3});
    } else {
      const auto& rgba = attributes.colours[v];
      lines.row("v", std::array{X(v, 0), X(v, 1), X(v, 2), rgba[0], rgba[1], rgba[2]});
    }
  }
  for (const std::array<double, 2>& coordinate : attributes.texture_coordinates)
    lines.row("vt", coordinate);
  if (attributes.normals) {
    const Points normals = vertex_normals(request.mesh.faces, X);
    for (Eigen::Index v = 0; v < X.rows(); ++v)
      lines.row("vn", {normals.row(v).data(), 3});
  }
  write_faces(request, lines);

  std::vector<std::string> left_out = attributes.uncarried;
  if (attributes.opacity) left_out.emplace_back("opacity of the vertex colours");
  return note_left_out("OBJ", std::move(left_out));
}

}  // namespace ibmfair::obj
