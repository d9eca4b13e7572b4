// Reads the positions and faces of a text OFF file, and the other values of its vertices.
#include <exception>
#include <functional>
#include <limits>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/io/make_room.h"
#include "ibmfair/io/off.h"
#include "ibmfair/io/token_cursor.h"

namespace ibmfair::off {
namespace {

constexpr std::int64_t largest_index = std::numeric_limits<Index>::max();
constexpr int most_colour_columns = 4;

void read_vertices(const Layout& layout, TokenCursor& cursor, Points& X) {
  const int extra = layout.extra_columns();
  for (std::int64_t v = 0; v < layout.vertex_count; ++v) {
    for (int c = 0; c < 3; ++c)
      X(v, c) = cursor.real();
    for (int c = 0; c < extra; ++c)
      cursor.token();
  }
}

void read_corners(const Layout& layout, TokenCursor& cursor, Polygons& faces) {
  cursor.skip_to_token();
  const char* where = cursor.position();
  const std::int64_t count = cursor.integer();
  if (count < 3) cursor.fail(where, "a face needs at least three corners");
  if (count > cursor.remaining()) cursor.fail(where, "the file ends before the face does");
  for (std::int64_t i = 0; i < count; ++i) {
    cursor.skip_to_token();
    where = cursor.position();
    const std::int64_t vertex = cursor.integer();
    if (vertex < 0 || vertex >= layout.vertex_count) {
      cursor.fail(where, fmt::format("there is no such vertex (the file has {}, counted from 0)",
                                     layout.vertex_count));
    }
    faces.corner.push_back(static_cast<Index>(vertex));
  }
  const auto end = static_cast<std::int64_t>(faces.corner.size());
  if (end > largest_index) cursor.fail(where, "too many face corners");
  faces.first.push_back(end);
}

using ColourVisitor = std::function<void(Index, std::string_view)>;

void read_faces(TokenCursor& cursor, const Layout& layout, Polygons& faces,
                const ColourVisitor& colour) {
  for (std::int64_t f = 0; f < layout.face_count; ++f) {
    read_corners(layout, cursor, faces);
    if (!layout.faces_end_lines || cursor.at_line_end()) continue;
    const char* first = cursor.position();
    const char* last = first;
    for (int columns = 0; !cursor.at_line_end(); ++columns) {
      const std::string_view token = cursor.token();
      if (columns == most_colour_columns) {
        cursor.fail(token.data(), "a face's colour has at most four numbers; more");
      }
      last = cursor.position();
    }
    if (colour) {
      colour(static_cast<Index>(f), {first, static_cast<std::size_t>(last - first)});
    }
  }
}

void read_text_body(const SourceBytes& source, Layout& layout, Mesh& mesh,
                    const ColourVisitor& colour = {}) {
  make_room(mesh, layout.vertex_count, layout.face_count, 3 * layout.face_count);
  TokenCursor cursor(source, layout.body, true);
  read_vertices(layout, cursor, mesh.X);
  read_text_faces(cursor, layout, mesh.faces, colour);
}

/// Copies the values after each position into the attributes.
void read_vertex_attributes(const SourceBytes& source, const Layout& layout,
                            MeshAttributes& attributes) {
  TokenCursor cursor(source, layout.body, true);
  attributes.byte_colours = layout.colour;
  for (std::int64_t v = 0; v < layout.vertex_count; ++v) {
    for (int c = 0; c < (layout.normal ? 6 : 3); ++c)
      cursor.token();
    if (layout.colour) {
      std::array<double, 4> rgba{0, 0, 0, 1};
      for (int c = 0; c < layout.colour_channels; ++c) {
        const std::string_view text = cursor.token();
        rgba[c] = real_or_zero(text);
        // Colours with a decimal point are in 0 .. 1, others in 0 .. 255.
        if (text.find('.') != std::string_view::npos) attributes.byte_colours = false;
      }
      attributes.colours.push_back(rgba);
    }
    if (layout.texture) {
      const double s = real_or_zero(cursor.token());
      attributes.texture_coordinates.push_back({s, real_or_zero(cursor.token())});
    }
  }
}

}  // namespace

// A colour after a face can be told from the next face only by the end of the line. If reading
// fails under the assumption that faces end lines, the file is read again as a plain sequence of
// numbers.
void read_text_faces(TokenCursor& cursor, Layout& layout, Polygons& faces,
                     const ColourVisitor& colour) {
  const TokenCursor start = cursor;
  layout.faces_end_lines = cursor.at_line_end();
  if (!layout.faces_end_lines) return read_faces(cursor, layout, faces, colour);
  try {
    read_faces(cursor, layout, faces, colour);
  } catch (const BadFile&) {
    const std::exception_ptr first_failure = std::current_exception();
    layout.faces_end_lines = false;
    faces = {};
    cursor.go_back(start);
    try {
      read_faces(cursor, layout, faces, colour);
    } catch (const BadFile&) {
      std::rethrow_exception(first_failure);
    }
  }
}

ParsedMesh read(const SourceBytes& source, std::string_view /*extension*/) {
  Layout layout = read_layout(source);
  ParsedMesh parsed;
  if (layout.binary) {
    parsed.mesh = read_binary_body(source, layout);
  } else {
    read_text_body(source, layout, parsed.mesh);
  }
  parsed.has_normals = layout.normal;
  parsed.has_texture_coordinates = layout.texture;
  return parsed;
}

MeshAttributes read_attributes(const SourceBytes& source, const Mesh& mesh) {
  Layout layout = read_layout(source);
  MeshAttributes attributes;
  attributes.normals = layout.normal;
  if (layout.binary) {
    if (layout.colour || layout.texture) {
      attributes.uncarried.emplace_back("colours and texture coordinates of a binary OFF file");
    }
    return attributes;
  }
  Mesh again;
  bool face_colours = false;
  read_text_body(source, layout, again, [&](Index, std::string_view) { face_colours = true; });
  if (face_colours && layout.faces_end_lines) attributes.uncarried.emplace_back("face colours");
  read_vertex_attributes(source, layout, attributes);
  attributes.opacity = layout.colour_channels == 4;
  if (attributes.byte_colours) {
    for (std::array<double, 4>& rgba : attributes.colours) {
      for (int c = 0; c < layout.colour_channels; ++c)
        rgba[c] /= 255.0;
    }
  }
  if (layout.texture) attributes.corner_texture = mesh.faces.corner;
  if (source.view().find('#') != std::string_view::npos) {
    attributes.uncarried.emplace_back("comments");
  }
  return attributes;
}

}  // namespace ibmfair::off
