// Generates a PLY file from the mesh and its attributes: in the encoding of the source if that is a
// PLY file, otherwise binary little-endian.
#include <algorithm>

#include <fmt/format.h>

#include "ibmfair/io/byte_sink.h"
#include "ibmfair/io/generate.h"
#include "ibmfair/io/normals.h"
#include "ibmfair/io/ply.h"
#include "ibmfair/io/ply_row_writer.h"
#include "ibmfair/io/precision.h"

namespace ibmfair::ply {
namespace {

/// The properties that the file will have, decided before its header is written.
struct Contents {
  bool colours = false;
  bool byte_colours = false;
  bool opacity = false;
  bool normals = false;
  bool vertex_texture = false;
  bool corner_texture = false;
  bool single = false;      // coordinates, normals and texture coordinates are float
  bool long_faces = false;  // some face has more corners (or texture values) than a byte can count
};

/// Whether the coordinates are to be float.
bool is_single(const GenerateRequest& request) {
  if (request.types != CoordinateTypes::as_declared || request.source == nullptr) {
    return request.types == CoordinateTypes::float32;
  }
  const Layout layout = read_layout(*request.source);
  return std::all_of(layout.position.begin(), layout.position.end(),
                     [&](int i) { return layout.vertices().properties[i].type == Type::float32; });
}

Contents plan(const GenerateRequest& request) {
  const MeshAttributes& attributes = request.attributes;
  Contents contents;
  contents.colours = !attributes.colours.empty();
  contents.byte_colours = attributes.byte_colours;
  contents.opacity = attributes.opacity;
  contents.normals = attributes.normals;
  if (!attributes.texture_coordinates.empty()) {
    contents.vertex_texture = texture_is_per_vertex(request.mesh, attributes);
    contents.corner_texture = !contents.vertex_texture;
  }
  if (is_single(request)) {
    require_float32_range(request.mesh.X, "a PLY file with float coordinates");
    contents.single = true;
  }
  const Polygons& faces = request.mesh.faces;
  constexpr std::size_t most = 127;  // twice as many texture values still fit into a byte
  for (Index f = 0; f < faces.size(); ++f) {
    contents.long_faces = contents.long_faces || faces[f].size() > most;
  }
  return contents;
}

std::string header(const GenerateRequest& request, const Contents& contents, Encoding encoding) {
  const auto name = [&] {
    if (encoding == Encoding::ascii) return "ascii";
    return encoding == Encoding::big_endian ? "binary_big_endian" : "binary_little_endian";
  };
  std::string text =
      fmt::format("ply\nformat {} 1.0\nelement vertex {}\n", name(), request.mesh.X.rows());
  const auto add = [&](std::string_view type, std::initializer_list<std::string_view> names) {
    for (const std::string_view property : names) {
      text += fmt::format("property {} {}\n", type, property);
    }
  };
  const std::string_view colour = contents.byte_colours ? "uchar" : "float";
  const std::string_view count = contents.long_faces ? "int" : "uchar";
  const std::string_view real = contents.single ? "float" : "double";
  add(real, {"x", "y", "z"});
  if (contents.normals) add(real, {"nx", "ny", "nz"});
  if (contents.colours) add(colour, {"red", "green", "blue"});
  if (contents.colours && contents.opacity) add(colour, {"alpha"});
  if (contents.vertex_texture) add(real, {"s", "t"});
  text += fmt::format("element face {}\nproperty list {} int vertex_indices\n",
                      request.mesh.faces.size(), count);
  if (contents.corner_texture) text += fmt::format("property list {} {} texcoord\n", count, real);
  return text + "end_header\n";
}

void write_real(double value, const Contents& contents, RowWriter& row) {
  row.number(contents.single ? Type::float32 : Type::float64, value);
}

void write_vertices(const GenerateRequest& request, const Contents& contents, RowWriter& row) {
  const Points& X = request.mesh.X;
  Points normals;
  if (contents.normals) normals = vertex_normals(request.mesh.faces, X);
  std::vector<std::array<double, 2>> texture;
  if (contents.vertex_texture) texture = texture_per_vertex(request.mesh, request.attributes);
  for (Eigen::Index v = 0; v < X.rows(); ++v) {
    const auto at = static_cast<std::size_t>(v);
    for (int c = 0; c < 3; ++c)
      write_real(X(v, c), contents, row);
    for (int c = 0; c < 3 && contents.normals; ++c)
      write_real(normals(v, c), contents, row);
    for (std::size_t c = 0; contents.colours && c < (contents.opacity ? 4 : 3); ++c) {
      const double value = request.attributes.colours[at][c];
      if (contents.byte_colours) {
        row.value(static_cast<std::uint8_t>(byte_colour(value)));
      } else {
        row.value(static_cast<float>(value));
      }
    }
    for (std::size_t c = 0; c < 2 && contents.vertex_texture; ++c)
      write_real(texture[at][c], contents, row);
    row.end_row();
  }
}

void write_faces(const GenerateRequest& request, const Contents& contents, RowWriter& row) {
  const Polygons& faces = request.mesh.faces;
  const auto count = [&](std::size_t size) {
    if (contents.long_faces) {
      row.value(static_cast<std::int32_t>(size));
    } else {
      row.value(static_cast<std::uint8_t>(size));
    }
  };
  for (Index f = 0; f < faces.size(); ++f) {
    count(faces[f].size());
    for (const Index v : faces[f])
      row.value(v);
    if (contents.corner_texture) {
      count(2 * faces[f].size());
      for (std::int64_t i = faces.first[f]; i < faces.first[f + 1]; ++i) {
        const Index t = request.attributes.corner_texture[i];
        for (std::size_t c = 0; c < 2; ++c) {
          write_real(t < 0 ? 0.0 : request.attributes.texture_coordinates[t][c], contents, row);
        }
      }
    }
    row.end_row();
  }
}

}  // namespace

std::vector<std::string> generate(const GenerateRequest& request, ByteSink& out) {
  const Encoding encoding =
      request.source != nullptr ? read_header(*request.source).encoding : Encoding::little_endian;
  const Contents contents = plan(request);
  out.write(header(request, contents, encoding));
  RowWriter row(out, encoding);
  write_vertices(request, contents, row);
  write_faces(request, contents, row);

  std::vector<std::string> left_out = request.attributes.uncarried;
  if (!request.attributes.face_statements.empty()) {
    left_out.emplace_back("groups, objects and materials");
  }
  std::vector<std::string> notes = note_left_out("PLY", std::move(left_out));
  if (contents.single) notes.emplace_back("the coordinates are rounded to float32");
  return notes;
}

}  // namespace ibmfair::ply
