#include "ibmfair/io/obj_excerpt.h"

#include <limits>

#include <fmt/format.h>

#include "ibmfair/io/obj.h"
#include "ibmfair/io/obj_scanner.h"

namespace ibmfair::obj {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

/// The next argument as a number; NaN if it is not a finite number.
double any_number(ObjScanner& scan) {
  const std::string_view text = scan.word();
  double value = missing;
  parse_real(text.data(), text.data() + text.size(), value);
  return value;
}

Eigen::RowVector4d read_colour(ObjScanner& scan) {
  for (int c = 0; c < 3; ++c)
    scan.skip_number();
  Eigen::RowVector4d colour = Eigen::RowVector4d::Constant(missing);
  int columns = 0;
  for (; !scan.at_statement_end(); ++columns) {
    const double value = any_number(scan);
    if (columns < 4) colour[columns] = value;
  }
  // A single number after x, y, z is a weight, not a colour.
  return columns == 3 || columns == 4 ? colour : Eigen::RowVector4d::Constant(missing);
}

}  // namespace

Excerpt::Excerpt(const SourceBytes& source, const Mesh& mesh, const std::vector<Index>& vertices,
                 const std::vector<std::int64_t>& corners)
    : colours(static_cast<Eigen::Index>(vertices.size()), 4), source_(source) {
  const auto wanted_vertices = static_cast<Eigen::Index>(vertices.size());
  Eigen::Index next_vertex = 0;
  Index vertex = 0;
  Index face = 0;
  const bool plain = ObjScanner::has_plain_lines(source);
  ObjScanner scan(source);
  for (; scan.next_statement(); plain ? scan.skip_plain_line() : void()) {
    const std::string_view keyword = scan.keyword();
    if (keyword == "v") {
      if (next_vertex < wanted_vertices && vertices[next_vertex] == vertex) {
        colours.row(next_vertex++) = read_colour(scan);
      }
      ++vertex;
    } else if (keyword == "f") {
      std::int64_t corner = mesh.faces.first[face];
      const std::int64_t stop = mesh.faces.first[++face];
      for (; texture.size() < corners.size() && corners[texture.size()] < stop; ++corner) {
        const RawCorner raw = scan.corner();
        if (corners[texture.size()] != corner) continue;
        texture.push_back(resolve_reference(raw.texture, textures_.size()));
        normal.push_back(resolve_reference(raw.normal, normals_.size()));
      }
    } else if (keyword == "vt") {
      textures_.push_back(scan.statement_start());
    } else if (keyword == "vn") {
      normals_.push_back(scan.statement_start());
    } else if (is_face_statement(keyword)) {
      face_statements.emplace_back(face, fmt::format("{} {}", keyword, scan.rest()));
    }
  }
  drop_dangling(texture, texture_count());
  drop_dangling(normal, normal_count());
}

Eigen::RowVector2d Excerpt::texture_coordinate(Index row) const {
  ObjScanner scan(source_, textures_[row]);
  scan.next_statement();
  const double u = any_number(scan);
  return {u, scan.at_statement_end() ? 0.0 : any_number(scan)};
}

Eigen::RowVector3d Excerpt::normal_vector(Index row) const {
  ObjScanner scan(source_, normals_[row]);
  scan.next_statement();
  Eigen::RowVector3d normal;
  for (int c = 0; c < 3; ++c)
    normal[c] = any_number(scan);
  return normal;
}

}  // namespace ibmfair::obj
