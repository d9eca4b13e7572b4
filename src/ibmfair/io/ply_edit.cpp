// Replaces single faces in a PLY file.
#include <algorithm>
#include <limits>

#include "ibmfair/io/byte_patcher.h"
#include "ibmfair/io/line_end.h"
#include "ibmfair/io/ply.h"
#include "ibmfair/io/ply_append.h"
#include "ibmfair/io/ply_body.h"
#include "ibmfair/io/ply_row_writer.h"

namespace ibmfair::ply {
namespace {

double largest_count(Type type) {
  return with_type(type, [](auto of) {
    return static_cast<double>(std::numeric_limits<typename decltype(of)::type>::max());
  });
}

class FaceEditor {
 public:
  FaceEditor(const EditRequest& request, const Layout& layout, ByteSink& out)
      : request_(request), layout_(layout), out_(out), file_(request.source, out) {
    if (layout.face_texture >= 0) {
      read_face_texture(request.source, layout, request.mesh, texture_);
    }
  }

  /// Whether the lists of the file can count the corners of the new faces.
  bool can_count() const {
    std::size_t most = 0;
    for (const FaceEdit& edit : request_.edits) {
      for (const std::vector<EditedCorner>& piece : edit.pieces)
        most = std::max(most, piece.size());
    }
    const auto& properties = layout_.faces().properties;
    const auto corners = static_cast<double>(most);
    return corners <= largest_count(properties[layout_.indices].count_type) &&
           (layout_.face_texture < 0 ||
            2 * corners <= largest_count(properties[layout_.face_texture].count_type));
  }

  void run() {
    std::int64_t count = layout_.faces().count;
    for (const FaceEdit& edit : request_.edits)
      count += std::ssize(edit.pieces) - 1;
    const std::string_view old = layout_.faces().count_text;
    std::string text;
    append_integer(text, count);
    file_.replace(old.data(), old.data() + old.size(), std::string_view(text));
    with_body(request_.source, layout_.header, [&](auto body) { edit_body(body); });
    file_.finish();
  }

 private:
  template <class Body>
  void edit_body(Body& body) {
    for (std::size_t e = 0; e < layout_.face; ++e)
      body.skip_rows(layout_.header.elements[e]);
    const std::vector<Property>& properties = layout_.faces().properties;
    std::vector<Span> spans(properties.size());
    body.start_element(layout_.faces());
    auto edit = request_.edits.begin();
    for (Index f = 0; f < layout_.faces().count && edit != request_.edits.end(); ++f) {
      body.start_row(f);
      for (std::size_t i = 0; i < spans.size(); ++i) {
        spans[i].first = body.position();
        body.skip(properties[i]);
        spans[i].last = body.after_value();
      }
      body.end_row();
      if (f == edit->face) replace(*edit++, spans);
    }
  }

  void replace(const FaceEdit& edit, const std::vector<Span>& spans) {
    file_.remove(spans.front().first, spans.back().last);
    const std::string_view line_end = layout_.header.encoding == Encoding::ascii
                                          ? first_line_end(request_.source.view())
                                          : std::string_view();
    for (const std::vector<EditedCorner>& piece : edit.pieces) {
      if (&piece != &edit.pieces.front()) out_.write(line_end);
      RowWriter row(out_, layout_.header.encoding);
      for (std::size_t i = 0; i < spans.size(); ++i) {
        const Property& property = layout_.faces().properties[i];
        if (static_cast<int>(i) == layout_.indices) {
          row.number(property.count_type, static_cast<double>(piece.size()));
          for (const EditedCorner& corner : piece)
            row.number(property.type, corner.vertex);
        } else if (static_cast<int>(i) == layout_.face_texture && has_texture(edit.face)) {
          write_texture(edit.face, piece, property, row);
        } else {
          row.verbatim({spans[i].first, static_cast<std::size_t>(spans[i].last - spans[i].first)});
        }
      }
    }
  }

  bool has_texture(Index face) const {
    return texture_.corner_texture[request_.mesh.faces.first[face]] >= 0;
  }

  void write_texture(Index face, const std::vector<EditedCorner>& piece, const Property& property,
                     RowWriter& row) const {
    const Index* rows = texture_.corner_texture.data() + request_.mesh.faces.first[face];
    row.number(property.count_type, 2.0 * static_cast<double>(piece.size()));
    for (const EditedCorner& corner : piece) {
      const auto& from = texture_.texture_coordinates[rows[corner.from]];
      const auto& to = texture_.texture_coordinates[rows[corner.to]];
      for (std::size_t c = 0; c < 2; ++c)
        row.number(property.type, from[c] + corner.along * (to[c] - from[c]));
    }
  }

  const EditRequest& request_;
  const Layout& layout_;
  ByteSink& out_;
  BytePatcher file_;
  MeshAttributes texture_;  // of the corners, if the faces have texture coordinates
};

}  // namespace

bool edit_faces(const EditRequest& request, ByteSink& out) {
  const Layout layout = read_layout(request.source);
  if (layout.strips) return false;
  FaceEditor editor(request, layout, out);
  if (!editor.can_count()) return false;
  editor.run();
  return true;
}

}  // namespace ibmfair::ply
