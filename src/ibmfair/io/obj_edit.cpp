// Replaces single faces in an OBJ text.
#include <algorithm>
#include <cmath>
#include <map>

#include "ibmfair/io/byte_patcher.h"
#include "ibmfair/io/line_end.h"
#include "ibmfair/io/obj.h"
#include "ibmfair/io/obj_lines.h"
#include "ibmfair/io/obj_scanner.h"

namespace ibmfair::obj {
namespace {

/// A corner of a face that is replaced: its text, and the rows that it refers to (-1: none).
struct OldCorner {
  std::string_view text;
  Index texture = -1;
  Index normal = -1;
};

/// The statement of a face that is replaced, from its keyword to its last corner.
struct OldFace {
  const char* first = nullptr;
  const char* last = nullptr;
  std::vector<OldCorner> corners;
};

/// Rows of `vt` or of `vn`: the statements of the text, and new rows, which follow those in number.
struct Rows {
  std::string_view keyword;
  std::vector<const char*> statements;
  std::vector<std::vector<double>> added;
  const char* last_relative = nullptr;  // the last corner that counts back from its own place

  /// Whether new rows may be inserted at `place` without a change of any other row's number.
  bool may_grow_at(const char* place) const {
    return added.empty() || ((statements.empty() || statements.back() < place) &&
                             (last_relative == nullptr || last_relative < place));
  }
};

class FaceEditor {
 public:
  explicit FaceEditor(const EditRequest& request) : request_(request) { read(); }

  bool run(ByteSink& out) {
    const std::string_view line_end = first_line_end(request_.source.view());
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < faces_.size(); ++i)
      texts.push_back(face_text(faces_[i], request_.edits[i], line_end));
    const char* place = faces_.front().first;
    if (!texture_.may_grow_at(place) || !normals_.may_grow_at(place)) return false;

    BytePatcher file(request_.source, out);
    file.copy_up_to(place);
    ObjLines lines(out, line_end);
    for (const Rows* rows : {&texture_, &normals_}) {
      for (const std::vector<double>& row : rows->added)
        lines.row(rows->keyword, row);
    }
    for (std::size_t i = 0; i < faces_.size(); ++i)
      file.replace(faces_[i].first, faces_[i].last, std::string_view(texts[i]));
    file.finish();
    return true;
  }

 private:
  void read() {
    ObjScanner scan(request_.source);
    auto edit = request_.edits.begin();
    for (Index face = 0; scan.next_statement();) {
      const std::string_view keyword = scan.keyword();
      if (keyword == "vt") {
        texture_.statements.push_back(scan.statement_start());
      } else if (keyword == "vn") {
        normals_.statements.push_back(scan.statement_start());
      } else if (keyword == "f") {
        const bool edited = edit != request_.edits.end() && edit->face == face++;
        OldFace old = read_face(scan);
        if (!edited) continue;
        faces_.push_back(std::move(old));
        ++edit;
      }
    }
    for (OldFace& face : faces_) {
      for (OldCorner& corner : face.corners) {
        if (corner.texture >= std::ssize(texture_.statements)) corner.texture = -1;
        if (corner.normal >= std::ssize(normals_.statements)) corner.normal = -1;
      }
    }
  }

  OldFace read_face(ObjScanner& scan) {
    OldFace face;
    face.first = scan.statement_start();
    while (!scan.at_statement_end()) {
      const char* start = scan.position();
      const RawCorner raw = scan.corner();
      if (raw.texture < 0) texture_.last_relative = start;
      if (raw.normal < 0) normals_.last_relative = start;
      face.last = scan.position_after();
      face.corners.push_back({{start, static_cast<std::size_t>(face.last - start)},
                              resolve_reference(raw.texture, texture_.statements.size()),
                              resolve_reference(raw.normal, normals_.statements.size())});
    }
    return face;
  }

  std::string face_text(const OldFace& face, const FaceEdit& edit, std::string_view line_end) {
    std::map<Index, Corner> inserted;  // by vertex: a vertex that several pieces share
    MemorySink text;
    ObjLines lines(text, line_end);
    for (const std::vector<EditedCorner>& piece : edit.pieces) {
      if (&piece != &edit.pieces.front()) text.write(line_end);
      lines.begin_face();
      for (const EditedCorner& corner : piece) {
        if (corner.is_old()) {
          text.write(" ");
          text.write(face.corners[corner.from].text);
        } else {
          const auto [known, is_new] = inserted.try_emplace(corner.vertex);
          if (is_new) known->second = between(face, corner);
          lines.corner(known->second);
        }
      }
    }
    return text.text();
  }

  Corner between(const OldFace& face, const EditedCorner& corner) {
    const OldCorner &from = face.corners[corner.from], &to = face.corners[corner.to];
    return {corner.vertex, row_between(texture_, from.texture, to.texture, corner.along, false),
            row_between(normals_, from.normal, to.normal, corner.along, true)};
  }

  Index row_between(Rows& rows, Index from, Index to, double along, bool unit) const {
    if (from < 0 || to < 0 || from == to) return from == to ? from : -1;
    const std::vector<double> a = numbers_of(rows.statements[from]);
    const std::vector<double> b = numbers_of(rows.statements[to]);
    std::vector<double> values(std::min(a.size(), b.size()));
    double square = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = a[i] + along * (b[i] - a[i]);
      square += values[i] * values[i];
    }
    if (unit && square > 0) {
      for (double& value : values)
        value /= std::sqrt(square);
    }
    rows.added.push_back(std::move(values));
    return static_cast<Index>(rows.statements.size() + rows.added.size() - 1);
  }

  std::vector<double> numbers_of(const char* statement) const {
    ObjScanner scan(request_.source, statement);
    scan.next_statement();
    std::vector<double> values;
    while (!scan.at_statement_end())
      values.push_back(scan.any_real());
    return values;
  }

  const EditRequest& request_;
  Rows texture_{"vt", {}, {}};
  Rows normals_{"vn", {}, {}};
  std::vector<OldFace> faces_;
};

}  // namespace

bool edit_faces(const EditRequest& request, ByteSink& out) {
  return FaceEditor(request).run(out);
}

}  // namespace ibmfair::obj
