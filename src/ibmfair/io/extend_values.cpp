#include "ibmfair/io/extend_values.h"

#include <cmath>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/sort_into_rows.h"
#include "ibmfair/io/normals.h"

namespace ibmfair {
namespace {

/// If known values have a smaller total weight than this at a vertex, they are too far away to be
/// used.
constexpr double least_weight = 1e-6;

[[noreturn]] void misfit(const std::string& what) {
  throw BadMesh("the extension does not fit the mesh: " + what);
}

void require_numbers(const std::vector<Index>& numbers, Index limit, std::string_view what) {
  for (const Index number : numbers) {
    if (number < 0 || number >= limit) {
      misfit(fmt::format("there is no {} {} (the source has {})", what, number, limit));
    }
  }
}

/// The faces around each new vertex.
CompressedRows faces_around_new_vertices(const Extension& extension, Index source_vertices) {
  return sort_into_rows(static_cast<Index>(extension.X.rows()), extension.F.size(),
                        [&](const auto& put) {
                          for (Eigen::Index f = 0; f < extension.F.rows(); ++f) {
                            for (const Index v : extension.F.row(f))
                              put(std::int64_t{v} - source_vertices, static_cast<Index>(f));
                          }
                        });
}

/// For each vertex of the rim, 1 if the file's normal is on the side of the area vectors of its
/// faces, -1 if it is on the other side, unknown if the file has no usable normal.
Eigen::VectorXd sides(const Mesh& mesh, const Extension& extension, const Points& at_rim) {
  std::vector<Index> place(static_cast<std::size_t>(mesh.X.rows()), -1);
  for (std::size_t i = 0; i < extension.rim.size(); ++i) {
    place[extension.rim[i]] = static_cast<Index>(i);
  }
  Points around = Points::Zero(at_rim.rows(), 3);
  for (Index f = 0; f < mesh.faces.size(); ++f) {
    for (const Index v : mesh.faces[f]) {
      const Index i = place[v];
      if (i >= 0) around.row(i) += polygon_area_vector(mesh.X, mesh.faces[f]);
    }
  }
  Eigen::VectorXd side(at_rim.rows());
  for (Eigen::Index i = 0; i < side.size(); ++i) {
    const double along = around.row(i).dot(at_rim.row(i));
    // Both comparisons are false for an unknown normal.
    side[i] = along > 0.0 ? 1.0 : along < 0.0 ? -1.0 : unknown;
  }
  return side;
}

}  // namespace

void require_fit(const Extension& extension, const Mesh& mesh) {
  const auto vertices = static_cast<Index>(mesh.X.rows());
  const std::int64_t all = std::int64_t{vertices} + extension.X.rows();
  if (all > std::numeric_limits<Index>::max()) misfit("too many vertices");
  if (extension.model_face.size() != static_cast<std::size_t>(extension.F.rows())) {
    misfit(fmt::format("{} model faces for {} faces", extension.model_face.size(),
                       extension.F.rows()));
  }
  require_numbers(extension.model_face, mesh.faces.size(), "face");
  require_numbers(extension.rim, vertices, "vertex");
  for (Eigen::Index i = 0; i < extension.F.size(); ++i) {
    const Index v = extension.F.data()[i];
    if (v < 0 || v >= all) misfit(fmt::format("there is no vertex {} (with it, {})", v, all));
  }
  for (Eigen::Index v = 0; v < extension.X.rows(); ++v) {
    if (!extension.X.row(v).allFinite()) {
      misfit(fmt::format("new vertex {} has a coordinate that is not finite", v));
    }
  }
}

Mesh extended_mesh(const Mesh& mesh, const Points& X, const Extension& extension) {
  Mesh result;
  result.X.resize(X.rows() + extension.X.rows(), 3);
  result.X << X, extension.X;
  result.faces = mesh.faces;
  for (Eigen::Index f = 0; f < extension.F.rows(); ++f)
    result.faces.add({extension.F.row(f).data(), 3});
  return result;
}

Eigen::MatrixXd extend_values(const Extension& extension, const Eigen::MatrixXd& at_rim) {
  const Eigen::Index columns = at_rim.cols();
  Eigen::MatrixXd result = Eigen::MatrixXd::Constant(extension.X.rows(), columns, unknown);
  if (result.size() == 0 || at_rim.rows() == 0) return result;

  const Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> known = at_rim.array().isFinite();
  if (!known.any()) return result;
  const bool complete = known.all();
  Eigen::MatrixXd values(at_rim.rows(), complete ? columns : 2 * columns);
  values.leftCols(columns) = known.select(at_rim, 0.0);
  if (!complete) values.rightCols(columns) = known.cast<double>();
  const Eigen::MatrixXd extended = extension.extend(values);
  if (extended.rows() != result.rows() || extended.cols() != values.cols()) {
    misfit(fmt::format("extend gives {} x {} values for {} vertices and {} columns",
                       extended.rows(), extended.cols(), result.rows(), values.cols()));
  }
  for (Eigen::Index c = 0; c < columns; ++c) {
    if (!known.col(c).any()) continue;
    const double low = known.col(c).select(at_rim.col(c), HUGE_VAL).minCoeff();
    const double high = known.col(c).select(at_rim.col(c), -HUGE_VAL).maxCoeff();
    for (Eigen::Index v = 0; v < result.rows(); ++v) {
      const double weight = complete ? 1.0 : extended(v, columns + c);
      const double value = extended(v, c) / weight;
      if (weight > least_weight && std::isfinite(value)) {
        result(v, c) = std::clamp(value, low, high);
      }
    }
  }
  return result;
}

Eigen::MatrixXd in_order_of_rim(const Extension& extension, const std::vector<Index>& sorted_rim,
                                const Eigen::MatrixXd& values) {
  Eigen::MatrixXd result(extension.rim.size(), values.cols());
  if (values.cols() == 0) return result;  // copying rows without columns would be invalid
  for (std::size_t i = 0; i < extension.rim.size(); ++i) {
    const std::size_t place = position_in(sorted_rim, extension.rim[i]);
    result.row(i) = values.row(place);
  }
  return result;
}

std::vector<Index> nearest_source_vertices(const Extension& extension, Index source_vertices) {
  const CompressedRows around = faces_around_new_vertices(extension, source_vertices);
  std::vector<Index> nearest(static_cast<std::size_t>(extension.X.rows()), -1), queue;
  const auto reach = [&](Eigen::Index face, Index from) {
    for (const Index v : extension.F.row(face)) {
      const Index at = v - source_vertices;
      if (at < 0 || nearest[at] >= 0) continue;
      nearest[at] = from;
      queue.push_back(at);
    }
  };
  for (Eigen::Index f = 0; f < extension.F.rows(); ++f) {
    for (const Index v : extension.F.row(f)) {
      if (v < source_vertices) reach(f, v);
    }
  }
  for (std::size_t done = 0; done < queue.size();) {
    const Index v = queue[done++];
    for (const Index face : around[v])
      reach(face, nearest[v]);
  }
  std::replace(nearest.begin(), nearest.end(), -1, 0);
  return nearest;
}

Points new_normals(const Mesh& mesh, const Points& X, const Extension& extension,
                   const Points& at_rim) {
  const auto source_vertices = static_cast<Index>(mesh.X.rows());
  Points normals = Points::Zero(extension.X.rows(), 3);
  constexpr std::array<Index, 3> corners{0, 1, 2};
  for (Eigen::Index f = 0; f < extension.F.rows(); ++f) {
    Points triangle(3, 3);
    for (int i = 0; i < 3; ++i) {
      const Index v = extension.F(f, i);
      triangle.row(i) = v < source_vertices ? X.row(v) : extension.X.row(v - source_vertices);
    }
    const Vec3 area = polygon_area_vector(triangle, corners);
    for (const Index v : extension.F.row(f)) {
      if (v >= source_vertices) normals.row(v - source_vertices) += area;
    }
  }
  const Eigen::MatrixXd side = extend_values(extension, sides(mesh, extension, at_rim));
  for (Eigen::Index v = 0; v < normals.rows(); ++v) {
    const double length = normals.row(v).norm();
    if (std::isnan(side(v, 0))) {
      normals.row(v).setConstant(unknown);
    } else if (length > 0.0) {
      normals.row(v) /= side(v, 0) < 0.0 ? -length : length;
    }
  }
  return normals;
}

}  // namespace ibmfair
