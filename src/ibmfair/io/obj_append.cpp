// Writes the vertices and faces of an extension at the end of an OBJ file.
#include <cmath>

#include "ibmfair/io/extend_attributes.h"
#include "ibmfair/io/extend_values.h"
#include "ibmfair/io/line_end.h"
#include "ibmfair/io/obj.h"
#include "ibmfair/io/obj_excerpt.h"
#include "ibmfair/io/obj_lines.h"

namespace ibmfair::obj {
namespace {

/// Ends the last line, and also the statement on it if a backslash would continue it.
void end_text(std::string_view text, std::string_view line_end, ByteSink& out) {
  const std::size_t last = text.find_last_not_of("\r\n");
  if (last == text.size() - 1) out.write(line_end);
  // After a carriage return, a line feed would only complete the line end CR LF, so another
  // carriage return is written.
  if (text[last] == '\\') out.write(text.back() == '\r' ? "\r" : line_end);
}

/// New rows of `vt` or of `vn`.
struct AppendedRows {
  Eigen::MatrixXd values;  // #new vertices
  NewRows rows;
};

class Appender {
 public:
  Appender(const PatchRequest& request, bool with_normals)
      : extension_(*request.extension),
        request_(request),
        source_vertices_(static_cast<Index>(request.mesh.X.rows())),
        corners_(with_normals || request.has_texture_coordinates
                     ? find_source_corners(request.mesh, extension_)
                     : SourceCorners{}),
        rim_(sorted_once(extension_.rim)),
        wanted_corners_(wanted(corners_)),
        excerpt_(request.source, request.mesh, rim_, wanted_corners_),
        colours_(extend_values(extension_, in_order_of_rim(extension_, rim_, excerpt_.colours))) {
    if (request.has_texture_coordinates) extend_texture();
    if (with_normals) extend_normals();
  }

  std::vector<std::string> run(ByteSink& out) const {
    const std::string_view text = request_.source.view();
    end_text(text, first_line_end(text), out);
    ObjLines lines(out, first_line_end(text));
    write_vertices(lines);
    write_rows("vt", texture_, lines);
    write_rows("vn", normals_, lines);
    std::vector<std::string> notes;
    write_faces(lines, notes);
    return notes;
  }

 private:
  static std::vector<std::int64_t> wanted(const SourceCorners& corners) {
    std::vector<std::int64_t> all = corners.of_rim;
    all.insert(all.end(), corners.of_face.begin(), corners.of_face.end());
    std::erase(all, -1);
    return sorted_once(std::move(all));
  }

  /// The row that a corner of the source refers to; -1 if there is none.
  Index row_of(const std::vector<Index>& rows, std::int64_t corner) const {
    return corner < 0 ? -1 : rows[position_in(wanted_corners_, corner)];
  }

  /// #rim x columns, the values to which the rim's corners refer; unknown if there are none.
  template <class Read>
  Eigen::MatrixXd at_rim(const std::vector<Index>& rows, Eigen::Index columns, Read&& read) const {
    Eigen::MatrixXd values = Eigen::MatrixXd::Constant(
        static_cast<Eigen::Index>(corners_.of_rim.size()), columns, unknown);
    for (std::size_t i = 0; i < corners_.of_rim.size(); ++i) {
      const Index row = row_of(rows, corners_.of_rim[i]);
      if (row >= 0) values.row(i) = read(row);
    }
    return values;
  }

  NewRows number(const Eigen::MatrixXd& values, const std::vector<Index>& rows, Index count) const {
    std::vector<Index> corner;
    for (const std::int64_t c : corners_.of_face)
      corner.push_back(row_of(rows, c));
    return number_new_rows(extension_, source_vertices_, values, std::move(corner), count);
  }

  void extend_texture() {
    texture_.values = extend_values(extension_, at_rim(excerpt_.texture, 2, [&](Index row) {
                                      return excerpt_.texture_coordinate(row);
                                    }));
    texture_.rows = number(texture_.values, excerpt_.texture, excerpt_.texture_count());
  }

  void extend_normals() {
    normals_.values = new_normals(
        request_.mesh, request_.X, extension_,
        at_rim(excerpt_.normal, 3, [&](Index row) { return excerpt_.normal_vector(row); }));
    normals_.rows = number(normals_.values, excerpt_.normal, excerpt_.normal_count());
  }

  /// Writes as many colour values for each new vertex as are known, which are as many as the
  /// vertices of the rim have.
  void write_vertices(ObjLines& lines) const {
    for (Eigen::Index v = 0; v < extension_.X.rows(); ++v) {
      std::array<double, 7> values{};
      std::size_t count = 0;
      for (; count < 3; ++count)
        values[count] = extension_.X(v, static_cast<Eigen::Index>(count));
      for (int c = 0; c < 4 && std::isfinite(colours_(v, c)); ++c)
        values[count++] = colours_(v, c);
      lines.row("v", {values.data(), count >= 6 ? count : 3});
    }
  }

  static void write_rows(std::string_view keyword, const AppendedRows& appended, ObjLines& lines) {
    for (const Index v : appended.rows.vertex) {
      const Eigen::VectorXd values = appended.values.row(v);
      lines.row(keyword, {values.data(), static_cast<std::size_t>(values.size())});
    }
  }

  void write_faces(ObjLines& lines, std::vector<std::string>& notes) const {
    const auto statements = statements_before_new_faces(excerpt_.face_statements, extension_,
                                                        request_.mesh.faces.size(), notes);
    auto statement = statements.begin();
    const auto row = [](const AppendedRows& appended, Eigen::Index i) {
      return appended.rows.corner.empty() ? -1 : appended.rows.corner[i];
    };
    for (Eigen::Index f = 0; f < extension_.F.rows(); ++f) {
      for (; statement != statements.end() && statement->first - request_.mesh.faces.size() == f;
           ++statement) {
        lines.statement(statement->second);
      }
      lines.begin_face();
      for (Eigen::Index i = 3 * f; i < 3 * f + 3; ++i) {
        lines.corner({extension_.F.data()[i], row(texture_, i), row(normals_, i)});
      }
      lines.end_face();
    }
  }

  const Extension& extension_;
  const PatchRequest& request_;
  Index source_vertices_;
  SourceCorners corners_;
  std::vector<Index> rim_;
  std::vector<std::int64_t> wanted_corners_;
  Excerpt excerpt_;
  Eigen::MatrixXd colours_;
  AppendedRows texture_;
  AppendedRows normals_;
};

}  // namespace

std::vector<std::string> append(const PatchRequest& request, bool with_normals, ByteSink& out) {
  return Appender(request, with_normals).run(out);
}

}  // namespace ibmfair::obj
