#include "support/holed_meshes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ibmfair/shapes/shapes.h"

namespace ibmfair::test {
namespace {

template <class Keep>
Mesh with_faces(const Mesh& mesh, const Keep& keep) {
  Mesh result;
  result.X = mesh.X;
  for (Index f = 0; f < mesh.faces.size(); ++f) {
    if (keep(f)) {
      result.faces.add(mesh.faces[f]);
    }
  }
  return result;
}

Mesh without_unused_vertices(const Mesh& mesh) {
  std::vector<Index> number(static_cast<std::size_t>(mesh.X.rows()), -1);
  std::vector<Index> used(mesh.faces.corner);
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (std::size_t i = 0; i < used.size(); ++i) {
    number[used[i]] = static_cast<Index>(i);
  }
  Mesh result = mesh;
  result.X = mesh.X(used, Eigen::all);
  for (Index& corner : result.faces.corner) {
    corner = number[corner];
  }
  return result;
}

const Vec3 cap_axis = Vec3(0.3, 0.5, 0.81).normalized();

/// Whether a point lies within `degrees` of the axis, seen from the origin.
bool in_cap(const Vec3& x, double degrees) {
  return x.dot(cap_axis) > std::cos(degrees * std::numbers::pi / 180) * x.norm();
}

/// The mesh without the faces at one vertex.
Mesh without_star(const Mesh& mesh, Index vertex) {
  return without_unused_vertices(with_faces(mesh, [&](Index f) {
    const auto corners = mesh.faces[f];
    return std::find(corners.begin(), corners.end(), vertex) == corners.end();
  }));
}

/// The mesh without two faces that touch in one vertex only. Either one boundary loop passes this
/// vertex twice, or each of two loops passes it once.
Mesh pinched(const Mesh& mesh) {
  const auto first = mesh.faces[0];
  for (Index f = 1; f < mesh.faces.size(); ++f) {
    const auto other = mesh.faces[f];
    const auto shared = std::count_if(other.begin(), other.end(), [&](Index v) {
      return std::find(first.begin(), first.end(), v) != first.end();
    });
    if (shared == 1) {
      return without_triangles(mesh, {0, f});
    }
  }
  return mesh;
}

}  // namespace

Mesh sphere(int level) {
  ShapeSettings settings;
  settings.subdivide = level;
  return make_shape("icosphere", settings);
}

Mesh without_triangles(const Mesh& mesh, const std::vector<Index>& faces) {
  return with_faces(
      mesh, [&](Index f) { return std::find(faces.begin(), faces.end(), f) == faces.end(); });
}

Mesh without_cap(const Mesh& mesh, double degrees) {
  return without_unused_vertices(with_faces(mesh, [&](Index f) {
    const auto corners = mesh.faces[f];
    return !std::all_of(corners.begin(), corners.end(),
                        [&](Index v) { return in_cap(mesh.X.row(v), degrees); });
  }));
}

Mesh with_island(const Mesh& ball, double lift) {
  constexpr double island = 12, hole = 40;
  Mesh mesh = without_unused_vertices(with_faces(ball, [&](Index f) {
    const auto corners = ball.faces[f];
    return std::none_of(corners.begin(), corners.end(), [&](Index v) {
      return in_cap(ball.X.row(v), hole) && !in_cap(ball.X.row(v), island);
    });
  }));
  for (Index v = 0; v < mesh.X.rows(); ++v) {
    if (in_cap(mesh.X.row(v), island)) {
      mesh.X.row(v) += lift * cap_axis.transpose();
    }
  }
  return mesh;
}

Mesh with_square_hole(const Mesh& sheet, Index cells) {
  const double half = cells / std::sqrt(sheet.faces.size() / 2.0);
  return without_unused_vertices(with_faces(sheet, [&](Index f) {
    Vec3 centre = Vec3::Zero();
    for (const Index v : sheet.faces[f]) {
      centre += sheet.X.row(v) / 3;
    }
    return std::abs(centre[0] - 0.5) > half / 2 || std::abs(centre[1] - 0.5) > half / 2;
  }));
}

Mesh with_many_holes(const Mesh& mesh) {
  return without_unused_vertices(with_faces(mesh, [&](Index f) {
    const auto corners = mesh.faces[f];
    return std::none_of(corners.begin(), corners.end(), [](Index v) { return v % 100 == 0; });
  }));
}

std::vector<NamedMesh> holed_meshes() {
  const Mesh ball = sphere(2);
  std::vector<NamedMesh> meshes{{"one triangle", without_triangles(ball, {7})},
                                {"a star", without_star(ball, 3)},
                                {"a cap", without_cap(ball, 40)},
                                {"half", without_cap(ball, 90)},
                                {"touching in a vertex", pinched(ball)}};
  for (const auto& [name, mesh] : closed_meshes()) {
    const Mesh triangles = mesh_from_triangles(mesh.X, triangulate(mesh).F);
    if (triangles.faces.size() > 40) {
      meshes.push_back({name + " with a star cut out", without_star(triangles, 5)});
    }
  }
  return meshes;
}

}  // namespace ibmfair::test
