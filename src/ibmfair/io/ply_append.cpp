#include "ibmfair/io/ply_append.h"

#include <algorithm>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/io/extend_attributes.h"
#include "ibmfair/io/extend_values.h"

namespace ibmfair::ply {
namespace {

/// Writes an empty list, a count of 0 in the count's type.
void write_empty_list(const Property& property, RowWriter& row) {
  row.number(property.count_type, 0.0);
}

}  // namespace

double number_at(const Span& span, Type type, Encoding encoding) {
  if (encoding == Encoding::ascii) {
    double value = unknown;
    parse_real(span.first, span.last, value);
    return value;
  }
  return binary_number(span.first, type, is_swapped(encoding));
}

VertexAppender::VertexAppender(const PatchRequest& request, const Layout& layout)
    : request_(request),
      layout_(layout),
      nearest_(
          nearest_source_vertices(*request.extension, static_cast<Index>(request.mesh.X.rows()))),
      wanted_(nearest_) {
  const std::vector<Index>& rim = request.extension->rim;
  wanted_.insert(wanted_.end(), rim.begin(), rim.end());
  wanted_ = sorted_once(std::move(wanted_));
  values_.setConstant(static_cast<Eigen::Index>(wanted_.size()),
                      static_cast<Eigen::Index>(layout.vertices().properties.size()), unknown);
}

void VertexAppender::see(std::int64_t row, const std::vector<Span>& spans) {
  if (next_ == wanted_.size() || wanted_[next_] != row) return;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const Property& property = layout_.vertices().properties[i];
    if (property.is_list) continue;
    values_(static_cast<Eigen::Index>(next_), static_cast<Eigen::Index>(i)) =
        number_at(spans[i], property.type, layout_.header.encoding);
  }
  ++next_;
}

VertexAppender::Source VertexAppender::source_of(std::size_t i) const {
  const Property& property = layout_.vertices().properties[i];
  if (property.is_list) return Source::empty_list;
  if (contains(layout_.position, i)) return Source::position;
  if (contains(layout_.colour, i)) return Source::extended;
  if (!is_real(property.type)) return Source::nearest;
  return contains(layout_.normal, i) ? Source::normal : Source::extended;
}

Eigen::RowVectorXd VertexAppender::values_of(Index vertex) const {
  return values_.row(position_in(wanted_, vertex));
}

void VertexAppender::write(const std::vector<std::optional<Type>>& stored, RowWriter& row) const {
  const Extension& extension = *request_.extension;
  const auto rim = static_cast<Eigen::Index>(extension.rim.size());
  Eigen::MatrixXd at_rim = Eigen::MatrixXd::Constant(rim, values_.cols(), unknown);
  Points normals_at_rim = Points::Constant(rim, 3, unknown);
  for (Eigen::Index i = 0; i < rim; ++i) {
    const Eigen::RowVectorXd values = values_of(extension.rim[i]);
    for (Eigen::Index c = 0; c < values.size(); ++c) {
      if (source_of(static_cast<std::size_t>(c)) == Source::extended) at_rim(i, c) = values[c];
    }
    for (int c = 0; c < 3 && layout_.normal[0] >= 0; ++c)
      normals_at_rim(i, c) = values[layout_.normal[c]];
  }
  const Eigen::MatrixXd extended = extend_values(extension, at_rim);
  Points normals;
  if (layout_.normal[0] >= 0) {
    normals = new_normals(request_.mesh, request_.X, extension, normals_at_rim);
    normals = normals.array().isFinite().select(normals, 0.0).eval();
  }
  const auto axis_of = [](const std::array<int, 3>& axes, std::size_t i) {
    return std::find(axes.begin(), axes.end(), static_cast<int>(i)) - axes.begin();
  };
  for (Eigen::Index v = 0; v < extension.X.rows(); ++v) {
    const Eigen::RowVectorXd near = values_of(nearest_[v]);
    for (std::size_t i = 0; i < stored.size(); ++i) {
      if (!stored[i]) continue;
      const auto column = static_cast<Eigen::Index>(i);
      switch (source_of(i)) {
        case Source::position:
          row.number(*stored[i], extension.X(v, axis_of(layout_.position, i)));
          break;
        case Source::normal:
          row.number(*stored[i], normals(v, axis_of(layout_.normal, i)));
          break;
        case Source::extended:
          row.number(*stored[i], extended(v, column));
          break;
        case Source::nearest:
          row.number(*stored[i], near[column]);
          break;
        case Source::empty_list:
          write_empty_list(layout_.vertices().properties[i], row);
          break;
      }
    }
    row.end_row();
  }
}

FaceAppender::FaceAppender(const PatchRequest& request, const Layout& layout)
    : request_(request), layout_(layout), models_(sorted_once(request.extension->model_face)) {
  if (layout.strips && layout.faces().properties.size() > 1) {
    throw CannotWrite(fmt::format(
        "{}: its triangle strips have properties besides their vertices, so that no new faces can "
        "be added; write another format",
        request.source.name()));
  }
  if (layout.face_texture >= 0) {
    read_face_texture(request.source, layout, request.mesh, texture_);
    extend_corner_texture(texture_, request.mesh, *request.extension);
  }
}

void FaceAppender::see(std::int64_t row, const std::vector<Span>& spans) {
  if (layout_.strips || texts_.size() == models_.size() || models_[texts_.size()] != row) return;
  const bool triangle = request_.mesh.faces[static_cast<Index>(row)].size() == 3;
  std::vector<std::string>& texts = texts_.emplace_back(spans.size());
  for (std::size_t i = 0; i < spans.size(); ++i) {
    // The length of a list may depend on the number of corners, so lists are copied from triangles
    // only.
    if (layout_.faces().properties[i].is_list && !triangle) continue;
    texts[i].assign(spans[i].first, spans[i].last);
  }
}

std::vector<std::string> FaceAppender::write(Type index_type, RowWriter& row) const {
  const Extension& extension = *request_.extension;
  const std::vector<Property>& properties = layout_.faces().properties;
  for (Eigen::Index f = 0; f < extension.F.rows(); ++f) {
    const Index model = extension.model_face[f];
    for (std::size_t i = 0; i < properties.size(); ++i) {
      if (static_cast<int>(i) == layout_.indices) {
        row.number(properties[i].count_type, 3.0);
        for (const Index v : extension.F.row(f))
          row.number(index_type, v);
      } else if (static_cast<int>(i) == layout_.face_texture) {
        write_texture(properties[i], f, row);
      } else if (const std::string& text = texts_[position_in(models_, model)][i]; text.empty()) {
        write_empty_list(properties[i], row);
      } else {
        row.verbatim(text);
      }
    }
    row.end_row();
  }
  const auto all = texture_.corner_texture.end();
  const auto without =
      std::count(all - (layout_.face_texture >= 0 ? extension.F.size() : 0), all, -1) / 3;
  if (without == 0) return {};
  return {fmt::format("{} new faces have no texture coordinates: those around have none", without)};
}

void FaceAppender::write_texture(const Property& property, Eigen::Index face,
                                 RowWriter& row) const {
  const Index* rows = texture_.corner_texture.data() + request_.mesh.faces.corner.size() + 3 * face;
  if (rows[0] < 0) return write_empty_list(property, row);
  row.number(property.count_type, 6.0);
  for (int corner = 0; corner < 3; ++corner) {
    for (const double value : texture_.texture_coordinates[rows[corner]])
      row.number(property.type, value);
  }
}

}  // namespace ibmfair::ply
