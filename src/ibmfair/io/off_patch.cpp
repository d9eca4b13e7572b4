// Copies an OFF file, changes only the coordinates of moved vertices and their normals, and inserts
// new rows after its vertices and after its faces.
#include <algorithm>
#include <cmath>
#include <optional>

#include "ibmfair/io/byte_patcher.h"
#include "ibmfair/io/extend_values.h"
#include "ibmfair/io/normals.h"
#include "ibmfair/io/off.h"
#include "ibmfair/io/token_cursor.h"

namespace ibmfair::off {
namespace {

using Token = std::string_view;

class TextPatcher {
 public:
  TextPatcher(const PatchRequest& request, const Layout& layout, ByteSink& out)
      : request_(request),
        layout_(layout),
        cursor_(request.source, layout.body, true),
        file_(request.source, out),
        out_(out) {
    if (layout_.normal && request.any_moved) {
      normals_.emplace(request.mesh.faces, request.mesh.X, request.X, request.moved);
    }
    if (request.extension == nullptr) return;
    rim_ = sorted_once(request.extension->rim);
    at_rim_.resize(static_cast<Eigen::Index>(rim_.size()), layout_.extra_columns());
  }

  void run() {
    replace_counts(extended_counts(request_, layout_), layout_, file_);
    row_.resize(3 + static_cast<std::size_t>(layout_.extra_columns()));
    for (std::int64_t v = 0; v < layout_.vertex_count; ++v) {
      for (Token& token : row_)
        token = cursor_.token();
      patch_vertex(v);
      if (request_.extension != nullptr) remember_vertex(v);
    }
    if (request_.extension != nullptr) {
      insert_vertices();
      insert_faces();
    }
    file_.finish();
  }

 private:
  void replace(Token token, double value) {
    file_.replace(token.data(), token.data() + token.size(), value);
  }

  double value(std::size_t column) const {
    double value = 0.0;
    parse_real(row_[column].data(), row_[column].data() + row_[column].size(), value);
    return value;
  }

  void patch_vertex(std::int64_t v) {
    for (int c = 0; c < 3; ++c) {
      if (request_.X(v, c) != request_.mesh.X(v, c)) {
        replace(row_[c], request_.X(v, c));
      }
    }
    if (!normals_ || !normals_->is_stale(v)) return;
    const Vec3 renewed = normals_->renew(v, {value(3), value(4), value(5)});
    for (int c = 0; c < 3; ++c)
      replace(row_[3 + static_cast<std::size_t>(c)], renewed[c]);
  }

  /// Whether a column of a vertex row is part of the colour.
  bool is_colour(std::size_t column) const {
    const std::size_t first = layout_.normal ? 6 : 3;
    return column >= first && column < first + static_cast<std::size_t>(layout_.colour_channels);
  }

  void remember_vertex(std::int64_t v) {
    for (std::size_t c = 3; c < row_.size(); ++c) {
      // Colours with a decimal point are in 0 .. 1, others in 0 .. 255.
      if (is_colour(c) && row_[c].find('.') != Token::npos) fractions_ = true;
    }
    const auto at = static_cast<std::size_t>(next_rim_);
    if (at == rim_.size() || rim_[at] != v) return;
    for (std::size_t c = 3; c < row_.size(); ++c)
      at_rim_(next_rim_, static_cast<Eigen::Index>(c - 3)) = value(c);
    ++next_rim_;
  }

  /// Inserts rows at the cursor: each on its own line if `end_lines`, otherwise all on the current
  /// line.
  template <class AppendRow>
  void insert_rows(Eigen::Index count, bool end_lines, AppendRow&& append_row) {
    if (count == 0) return;
    TokenCursor place = cursor_;
    std::string_view line_end;
    if (end_lines) line_end = place.take_line_end();
    file_.copy_up_to(place.position());
    if (end_lines && line_end.empty()) {
      line_end = first_line_end(request_.source.view());
      out_.write(line_end);
    }
    std::string line;
    for (Eigen::Index i = 0; i < count; ++i) {
      line.clear();
      append_row(i, line);
      // append_row() puts a blank before every number; the first is not needed on a new line.
      out_.write(end_lines ? Token(line).substr(1) : Token(line));
      out_.write(line_end);
    }
  }

  void insert_vertices() {
    const Extension& extension = *request_.extension;
    const Eigen::MatrixXd columns =
        extend_columns(request_, layout_, in_order_of_rim(extension, rim_, at_rim_));
    const bool end_lines = TokenCursor(cursor_).at_line_end();
    insert_rows(extension.X.rows(), end_lines, [&](Eigen::Index v, std::string& line) {
      for (std::size_t c = 0; c < row_.size(); ++c) {
        const double number = c < 3 ? extension.X(v, static_cast<Eigen::Index>(c))
                                    : columns(v, static_cast<Eigen::Index>(c - 3));
        if (is_colour(c) && fractions_) {
          append_fraction(line, number);
        } else if (is_colour(c)) {
          line += ' ';
          append_integer(line, std::llround(number));
        } else {
          line += ' ';
          append_real(line, number);
        }
      }
    });
  }

  void insert_faces() {
    const Extension& extension = *request_.extension;
    const std::vector<Index> models = sorted_once(extension.model_face);
    std::vector<Token> colours(models.size());  // the text of the colours
    Polygons unused;
    read_text_faces(cursor_, layout_, unused, [&](Index face, Token colour) {
      const auto model = std::lower_bound(models.begin(), models.end(), face);
      if (model != models.end() && *model == face) {
        colours[model - models.begin()] = colour;
      }
    });
    insert_rows(extension.F.rows(), layout_.faces_end_lines,
                [&](Eigen::Index f, std::string& line) {
                  line += " 3";
                  for (const Index v : extension.F.row(f)) {
                    line += ' ';
                    append_integer(line, v);
                  }
                  const Index model = extension.model_face[f];
                  const Token colour = colours[position_in(models, model)];
                  if (layout_.faces_end_lines && !colour.empty()) line.append(" ").append(colour);
                });
  }

  const PatchRequest& request_;
  Layout layout_;
  TokenCursor cursor_;
  BytePatcher file_;
  ByteSink& out_;
  std::vector<Token> row_;  // the numbers in the row of the current vertex
  std::optional<RenewedNormals> normals_;
  std::vector<Index> rim_;  // in ascending order
  Eigen::MatrixXd at_rim_;  // the values after the position, in the order of rim_
  Eigen::Index next_rim_ = 0;
  bool fractions_ = false;
};

}  // namespace

std::vector<std::string> patch(const PatchRequest& request, ByteSink& out) {
  const Layout layout = read_layout(request.source);
  if (layout.binary) return patch_binary(request, layout, out);
  TextPatcher(request, layout, out).run();
  return {};
}

}  // namespace ibmfair::off
