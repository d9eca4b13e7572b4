// Generates a text OFF file from the mesh and its attributes.
#include <fmt/format.h>

#include "ibmfair/io/byte_sink.h"
#include "ibmfair/io/generate.h"
#include "ibmfair/io/normals.h"
#include "ibmfair/io/numbers.h"
#include "ibmfair/io/off.h"

namespace ibmfair::off {
namespace {

void append(std::string& line, double value) {
  if (!line.empty()) line += ' ';
  append_real(line, value);
}

void append_colour(std::string& line, const MeshAttributes& attributes, std::size_t v) {
  for (std::size_t c = 0; c < 4; ++c) {
    const double value = attributes.colours[v][c];
    if (attributes.byte_colours) {
      line += ' ';
      append_integer(line, byte_colour(value));
    } else {
      append_fraction(line, value);
    }
  }
}

void write_vertices(const GenerateRequest& request, bool with_texture, ByteSink& out) {
  const Points& X = request.mesh.X;
  const MeshAttributes& attributes = request.attributes;
  Points normals;
  if (attributes.normals) normals = vertex_normals(request.mesh.faces, X);
  std::vector<std::array<double, 2>> texture;
  if (with_texture) texture = texture_per_vertex(request.mesh, attributes);
  std::string line;
  for (Eigen::Index v = 0; v < X.rows(); ++v) {
    line.clear();
    for (int c = 0; c < 3; ++c)
      append(line, X(v, c));
    for (int c = 0; c < 3 && attributes.normals; ++c)
      append(line, normals(v, c));
    const auto at = static_cast<std::size_t>(v);
    if (!attributes.colours.empty()) append_colour(line, attributes, at);
    for (std::size_t c = 0; c < 2 && with_texture; ++c)
      append(line, texture[at][c]);
    line += '\n';
    out.write(line);
  }
}

}  // namespace

void append_fraction(std::string& line, double value) {
  append(line, value);
  if (line.find_first_of(".e", line.rfind(' ')) == std::string::npos) line += ".0";
}

std::vector<std::string> generate(const GenerateRequest& request, ByteSink& out) {
  const MeshAttributes& attributes = request.attributes;
  const Polygons& faces = request.mesh.faces;
  const bool has_texture = !attributes.texture_coordinates.empty();
  const bool with_texture = has_texture && texture_is_per_vertex(request.mesh, attributes);

  out.write(fmt::format("{}{}{}OFF\n{} {} 0\n", with_texture ? "ST" : "",
                        attributes.colours.empty() ? "" : "C", attributes.normals ? "N" : "",
                        request.mesh.X.rows(), faces.size()));
  write_vertices(request, with_texture, out);
  std::string line;
  for (Index f = 0; f < faces.size(); ++f) {
    line.clear();
    append_integer(line, static_cast<std::int64_t>(faces[f].size()));
    for (const Index v : faces[f]) {
      line += ' ';
      append_integer(line, v);
    }
    line += '\n';
    out.write(line);
  }

  std::vector<std::string> left_out = attributes.uncarried;
  if (has_texture && !with_texture) left_out.emplace_back("texture coordinates (they have seams)");
  if (!attributes.face_statements.empty()) left_out.emplace_back("groups, objects and materials");
  return note_left_out("OFF", std::move(left_out));
}

}  // namespace ibmfair::off
