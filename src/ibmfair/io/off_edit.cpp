// Replaces single faces in an OFF file, text or binary.
#include <algorithm>

#include "ibmfair/io/binary_bytes.h"
#include "ibmfair/io/byte_patcher.h"
#include "ibmfair/io/line_end.h"
#include "ibmfair/io/off.h"
#include "ibmfair/io/token_cursor.h"

namespace ibmfair::off {
namespace {

std::int64_t count_edges(const Polygons& faces) {
  std::vector<std::pair<Index, Index>> edges;
  for (Index f = 0; f < faces.size(); ++f) {
    Index previous = faces[f].back();
    for (const Index v : faces[f]) {
      edges.emplace_back(std::min(v, previous), std::max(v, previous));
      previous = v;
    }
  }
  std::sort(edges.begin(), edges.end());
  return std::unique(edges.begin(), edges.end()) - edges.begin();
}

/// The counts of vertices, faces and edges after the edits. The number of edges, which few files
/// give, is changed only if it is right.
std::array<std::int64_t, 3> edited_counts(const EditRequest& request, const Layout& layout) {
  std::array<std::int64_t, 3> counts{layout.vertex_count, layout.face_count, layout.edge_count};
  for (const FaceEdit& edit : request.edits)
    counts[1] += std::ssize(edit.pieces) - 1;
  if (counts[2] > 0 && counts[2] == count_edges(request.mesh.faces)) {
    counts[2] = count_edges(with_edited_faces(request.mesh, request.edits).faces);
  }
  return counts;
}

class TextEditor {
 public:
  TextEditor(const EditRequest& request, const Layout& layout, ByteSink& out)
      : request_(request),
        layout_(layout),
        cursor_(request.source, layout.body, true),
        file_(request.source, out) {}

  void run() {
    replace_counts(edited_counts(request_, layout_), layout_, file_);
    for (std::int64_t i = 0; i < layout_.vertex_count * (3 + layout_.extra_columns()); ++i)
      cursor_.token();
    TokenCursor ahead = cursor_;
    Polygons unused;
    read_text_faces(ahead, layout_, unused, {});  // finds out whether faces end lines
    const std::string_view line_end = first_line_end(request_.source.view());
    auto edit = request_.edits.begin();
    for (Index f = 0; f < layout_.face_count && edit != request_.edits.end(); ++f) {
      cursor_.skip_to_token();
      const char* first = cursor_.position();
      const std::int64_t corners = cursor_.integer();
      for (std::int64_t i = 0; i < corners; ++i)
        cursor_.token();
      const std::string_view colour = take_colour();
      if (f != edit->face) continue;
      const char* last = cursor_.position();
      file_.replace(first, last, std::string_view(rows(*edit++, colour, line_end)));
    }
    file_.finish();
  }

 private:
  /// The colour after the corners of a face; the cursor stays at the end of the last number.
  std::string_view take_colour() {
    if (!layout_.faces_end_lines) return {};
    TokenCursor ahead = cursor_;
    const char* first = nullptr;
    while (!ahead.at_line_end()) {
      const std::string_view token = ahead.token();
      if (first == nullptr) first = token.data();
      cursor_.go_back(ahead);
    }
    return first == nullptr
               ? std::string_view()
               : std::string_view(first, static_cast<std::size_t>(cursor_.position() - first));
  }

  std::string rows(const FaceEdit& edit, std::string_view colour, std::string_view line_end) const {
    std::string text;
    for (const std::vector<EditedCorner>& piece : edit.pieces) {
      if (!text.empty()) text += layout_.faces_end_lines ? line_end : std::string_view(" ");
      append_integer(text, std::ssize(piece));
      for (const EditedCorner& corner : piece) {
        text += ' ';
        append_integer(text, corner.vertex);
      }
      if (!colour.empty()) text.append(" ").append(colour);
    }
    return text;
  }

  const EditRequest& request_;
  Layout layout_;
  TokenCursor cursor_;
  BytePatcher file_;
};

void edit_binary(const EditRequest& request, Layout layout, ByteSink& out) {
  constexpr std::int64_t word = 4;           // every number in the file has four bytes
  read_binary_body(request.source, layout);  // finds the byte order and the dialect
  BytePatcher file(request.source, out);
  file.remove(layout.body, layout.body + 3 * word);
  for (const std::int64_t count : edited_counts(request, layout))
    store(out, static_cast<std::int32_t>(count), layout.swapped);
  const char* p = layout.body + word * (3 + layout.vertex_count * (3 + layout.extra_columns()));
  auto edit = request.edits.begin();
  for (Index f = 0; f < layout.face_count && edit != request.edits.end(); ++f) {
    const char* first = p;
    p += word * (1 + load<std::int32_t>(p, layout.swapped));
    const char* colour = p;
    if (layout.colour_counts) p += word * (1 + load<std::int32_t>(p, layout.swapped));
    if (f != edit->face) continue;
    file.remove(first, p);
    for (const std::vector<EditedCorner>& piece : edit->pieces) {
      store(out, static_cast<std::int32_t>(piece.size()), layout.swapped);
      for (const EditedCorner& corner : piece)
        store(out, corner.vertex, layout.swapped);
      out.write({colour, static_cast<std::size_t>(p - colour)});
    }
    ++edit;
  }
  file.finish();
}

}  // namespace

bool edit_faces(const EditRequest& request, ByteSink& out) {
  const Layout layout = read_layout(request.source);
  if (layout.binary) {
    edit_binary(request, layout, out);
  } else {
    TextEditor(request, layout, out).run();
  }
  return true;
}

}  // namespace ibmfair::off
