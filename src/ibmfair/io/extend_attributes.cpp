#include "ibmfair/io/extend_attributes.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include "ibmfair/io/extend_values.h"

namespace ibmfair {
namespace {

using Statement = std::pair<Index, std::string>;

std::string_view keyword_of(const Statement& statement) {
  const std::string_view text = statement.second;
  return text.substr(0, text.find(' '));
}

/// The statements of one keyword, in the order of the faces that they precede.
class Timeline {
 public:
  Timeline(std::string_view keyword, std::string_view none, const std::vector<Statement>& of_source)
      : none_(none) {
    for (const Statement& statement : of_source) {
      if (keyword_of(statement) == keyword) statements_.push_back(&statement);
    }
    current_ = statements_.empty() ? std::string_view() : statements_.back()->second;
  }

  /// The statement to write before the next new face; empty if the statement in effect is right
  /// already. Adds 1 to `lost` if the model face has no statement, but the format cannot express
  /// that.
  std::string_view before(Index model_face, Index& lost) {
    std::string_view wanted = at(model_face);
    if (wanted.empty() && !current_.empty()) {
      wanted = none_;
      if (wanted.empty()) ++lost;
    }
    if (wanted.empty() || wanted == current_) return {};
    current_ = wanted;
    return current_;
  }

 private:
  std::string_view at(Index face) const {
    const auto later =
        std::upper_bound(statements_.begin(), statements_.end(), face,
                         [](Index f, const Statement* statement) { return f < statement->first; });
    return later == statements_.begin() ? std::string_view() : (*std::prev(later))->second;
  }

  std::string_view none_;
  std::vector<const Statement*> statements_;
  std::string_view current_;
};

void extend_colours(MeshAttributes& attributes, const Extension& extension) {
  Eigen::MatrixXd at_rim(extension.rim.size(), 4);
  for (std::size_t i = 0; i < extension.rim.size(); ++i) {
    const auto v = static_cast<std::size_t>(extension.rim[i]);
    at_rim.row(i) = Eigen::RowVector4d::Map(attributes.colours[v].data());
  }
  const Eigen::MatrixXd values = extend_values(extension, at_rim);
  for (Eigen::Index v = 0; v < values.rows(); ++v) {
    std::array<double, 4>& colour = attributes.colours.emplace_back();
    for (std::size_t c = 0; c < 4; ++c) {
      const double value = values(v, static_cast<Eigen::Index>(c));
      colour[c] = std::isfinite(value) ? value : 1.0;
    }
  }
}

}  // namespace

SourceCorners find_source_corners(const Mesh& mesh, const Extension& extension) {
  const Polygons& faces = mesh.faces;
  const auto vertices = static_cast<Index>(mesh.X.rows());
  // For each vertex, its first corner in the source.
  std::vector<std::int64_t> any(static_cast<std::size_t>(vertices), -1);
  for (std::size_t i = faces.corner.size(); i-- > 0;)
    any[faces.corner[i]] = static_cast<std::int64_t>(i);

  SourceCorners result;
  result.of_face.assign(static_cast<std::size_t>(extension.F.size()), -1);
  std::vector<std::int64_t> of_vertex = any;
  for (std::size_t i = result.of_face.size(); i-- > 0;) {
    const Index v = extension.F.data()[i];
    if (v >= vertices) continue;
    const Index model = extension.model_face[i / 3];
    const std::span<const Index> polygon = faces[model];
    const auto found = std::find(polygon.begin(), polygon.end(), v);
    if (found == polygon.end()) {
      result.of_face[i] = any[v];
    } else {
      of_vertex[v] = result.of_face[i] = faces.first[model] + (found - polygon.begin());
    }
  }
  for (const Index v : extension.rim)
    result.of_rim.push_back(of_vertex[v]);
  return result;
}

NewRows number_new_rows(const Extension& extension, Index source_vertices,
                        const Eigen::MatrixXd& values, std::vector<Index> corner, Index count) {
  NewRows result;
  std::vector<Index> row(static_cast<std::size_t>(values.rows()), -1);
  for (Eigen::Index v = 0; v < values.rows(); ++v) {
    if (!values.row(v).allFinite()) continue;
    row[v] = count + static_cast<Index>(result.vertex.size());
    result.vertex.push_back(static_cast<Index>(v));
  }
  for (std::size_t i = 0; i < corner.size(); ++i) {
    const Index v = extension.F.data()[i];
    if (v >= source_vertices) corner[i] = row[v - source_vertices];
  }
  for (auto face = corner.begin(); face != corner.end(); face += 3) {
    if (std::count(face, face + 3, -1) > 0) std::fill(face, face + 3, -1);
  }
  result.corner = std::move(corner);
  return result;
}

void extend_corner_texture(MeshAttributes& attributes, const Mesh& mesh,
                           const Extension& extension) {
  std::vector<std::array<double, 2>>& coordinates = attributes.texture_coordinates;
  const SourceCorners corners = find_source_corners(mesh, extension);
  const auto row = [&](std::int64_t corner) {
    return corner < 0 ? -1 : attributes.corner_texture[corner];
  };
  Eigen::MatrixXd at_rim =
      Eigen::MatrixXd::Constant(static_cast<Eigen::Index>(extension.rim.size()), 2, unknown);
  for (std::size_t i = 0; i < extension.rim.size(); ++i) {
    const Index t = row(corners.of_rim[i]);
    if (t < 0) continue;
    at_rim.row(i) = Eigen::RowVector2d::Map(coordinates[t].data());
  }
  std::vector<Index> corner;
  for (const std::int64_t c : corners.of_face)
    corner.push_back(row(c));
  const Eigen::MatrixXd values = extend_values(extension, at_rim);
  const NewRows added = number_new_rows(extension, static_cast<Index>(mesh.X.rows()), values,
                                        std::move(corner), static_cast<Index>(coordinates.size()));
  for (const Index v : added.vertex)
    coordinates.push_back({values(v, 0), values(v, 1)});
  attributes.corner_texture.insert(attributes.corner_texture.end(), added.corner.begin(),
                                   added.corner.end());
}

std::vector<Statement> statements_before_new_faces(const std::vector<Statement>& of_source,
                                                   const Extension& extension, Index source_faces,
                                                   std::vector<std::string>& notes) {
  struct Kind {
    std::string_view keyword;
    std::string_view none;  // the statement for "none of this kind", if the format has one
    std::string_view title;
  };
  constexpr std::array<Kind, 4> kinds{{{"o", "", "object"},
                                       {"g", "g default", "group"},
                                       {"usemtl", "", "material"},
                                       {"s", "s off", "smoothing group"}}};
  std::vector<Timeline> timelines;
  timelines.reserve(kinds.size());
  for (const Kind& kind : kinds)
    timelines.emplace_back(kind.keyword, kind.none, of_source);

  std::vector<Statement> result;
  std::array<Index, kinds.size()> lost{};
  for (std::size_t f = 0; f < extension.model_face.size(); ++f) {
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      const std::string_view text = timelines[k].before(extension.model_face[f], lost[k]);
      if (!text.empty()) result.emplace_back(source_faces + static_cast<Index>(f), text);
    }
  }
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    if (lost[k] == 0) continue;
    notes.push_back(
        fmt::format("{} new faces beside faces without {} have one: after the first, "
                    "OBJ has no way to say that there is none",
                    lost[k], kinds[k].title));
  }
  return result;
}

MeshAttributes extended_attributes(MeshAttributes attributes, const Mesh& mesh,
                                   const Extension& extension, std::vector<std::string>& notes) {
  if (!attributes.colours.empty()) extend_colours(attributes, extension);
  if (attributes.texture_coordinates.empty()) {
    // The list may exist although no texture coordinate was readable.
    attributes.corner_texture.clear();
  } else {
    extend_corner_texture(attributes, mesh, extension);
  }
  for (Statement& statement : statements_before_new_faces(attributes.face_statements, extension,
                                                          mesh.faces.size(), notes)) {
    attributes.face_statements.push_back(std::move(statement));
  }
  return attributes;
}

}  // namespace ibmfair
