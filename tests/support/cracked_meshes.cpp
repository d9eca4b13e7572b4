#include "support/cracked_meshes.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <span>
#include <tuple>

#include "support/states.h"

namespace ibmfair::test {
namespace {

/// Makes the vertices of finer faces, and each vertex on an edge of the coarse mesh once.
class FinerVertices {
 public:
  explicit FinerVertices(const Points& X) {
    for (const auto x : X.rowwise()) {
      points_.push_back(x);
    }
  }

  /// The vertex i / n of the way from a to b.
  Index on_edge(Index a, Index b, Index i, Index n) {
    if (i == 0 || i == n) {
      return i == 0 ? a : b;
    }
    if (a > b) {
      return on_edge(b, a, n - i, n);
    }
    const Index common = std::gcd(i, n);
    const auto [known, is_new] =
        on_edges_.try_emplace({a, b, i / common, n / common}, static_cast<Index>(points_.size()));
    if (is_new) {
      const double share = static_cast<double>(i) / n;
      points_.emplace_back(points_[a] + share * (points_[b] - points_[a]));
    }
    return known->second;
  }

  Index inside(const Vec3& x) {
    points_.push_back(x);
    return static_cast<Index>(points_.size()) - 1;
  }

  const Vec3& operator[](Index v) const { return points_[v]; }

  Points all() const {
    Points X(static_cast<Eigen::Index>(points_.size()), 3);
    for (std::size_t v = 0; v < points_.size(); ++v) {
      X.row(static_cast<Eigen::Index>(v)) = points_[v];
    }
    return X;
  }

 private:
  std::vector<Vec3> points_;
  std::map<std::tuple<Index, Index, Index, Index>, Index> on_edges_;
};

void cut_triangle(std::span<const Index> t, Index n, FinerVertices& vertices, Polygons& faces) {
  const Vec3 a = vertices[t[0]], b = vertices[t[1]], c = vertices[t[2]];
  std::map<std::pair<Index, Index>, Index> grid;  // i steps towards b, k steps towards c
  for (Index i = 0; i <= n; ++i) {
    for (Index k = 0; i + k <= n; ++k) {
      grid[{i, k}] = k == 0       ? vertices.on_edge(t[0], t[1], i, n)
                     : i == 0     ? vertices.on_edge(t[0], t[2], k, n)
                     : i + k == n ? vertices.on_edge(t[1], t[2], k, n)
                                  : vertices.inside(a + i * (b - a) / n + k * (c - a) / n);
    }
  }
  for (Index i = 0; i < n; ++i) {
    for (Index k = 0; i + k < n; ++k) {
      faces.add(std::array{grid[{i, k}], grid[{i + 1, k}], grid[{i, k + 1}]});
      if (i + k + 1 < n) {
        faces.add(std::array{grid[{i + 1, k}], grid[{i + 1, k + 1}], grid[{i, k + 1}]});
      }
    }
  }
}

void cut_square(std::span<const Index> q, Index n, FinerVertices& vertices, Polygons& faces) {
  const Vec3 a = vertices[q[0]], u = vertices[q[1]] - a, w = vertices[q[3]] - a;
  std::map<std::pair<Index, Index>, Index> grid;
  for (Index i = 0; i <= n; ++i) {
    for (Index k = 0; k <= n; ++k) {
      grid[{i, k}] = k == 0   ? vertices.on_edge(q[0], q[1], i, n)
                     : k == n ? vertices.on_edge(q[3], q[2], i, n)
                     : i == 0 ? vertices.on_edge(q[0], q[3], k, n)
                     : i == n ? vertices.on_edge(q[1], q[2], k, n)
                              : vertices.inside(a + i * u / n + k * w / n);
    }
  }
  for (Index i = 0; i < n; ++i) {
    for (Index k = 0; k < n; ++k) {
      faces.add(std::array{grid[{i, k}], grid[{i + 1, k}], grid[{i + 1, k + 1}], grid[{i, k + 1}]});
    }
  }
}

template <class Cut>
Mesh cut_unevenly(const Mesh& mesh, const std::vector<Index>& parts, unsigned seed,
                  const Cut& cut) {
  std::mt19937 random(seed);
  FinerVertices vertices(mesh.X);
  Mesh result;
  for (Index f = 0; f < mesh.faces.size(); ++f) {
    cut(mesh.faces[f], parts[random() % parts.size()], vertices, result.faces);
  }
  result.X = vertices.all();
  return result;
}

}  // namespace

Mesh unevenly_cut(const Mesh& mesh, const std::vector<Index>& parts, unsigned seed) {
  return cut_unevenly(mesh, parts, seed, cut_triangle);
}

Mesh unevenly_cut_cube(const std::vector<Index>& parts, unsigned seed) {
  const auto meshes = closed_meshes();
  const auto cube = std::ranges::find(meshes, "quadrilateral cube", &NamedMesh::name);
  return cut_unevenly(cube->mesh, parts, seed, cut_square);
}

Mesh apart(const Mesh& mesh) {
  Mesh result;
  result.X = mesh.X(mesh.faces.corner, Eigen::all);
  result.faces = mesh.faces;
  std::iota(result.faces.corner.begin(), result.faces.corner.end(), 0);
  return result;
}

Mesh cut_in_two(const Mesh& mesh, double distance) {
  const Vec3 middle = mesh.X.colwise().mean(), normal = Vec3(0.3, 0.5, 0.81).normalized();
  std::vector<std::uint8_t> above;
  for (Index f = 0; f < mesh.faces.size(); ++f) {
    Vec3 sum = Vec3::Zero();
    for (const Index v : mesh.faces[f]) {
      sum += mesh.X.row(v).transpose() - middle;
    }
    above.push_back(sum.dot(normal) > 0 ? 1 : 0);
  }
  std::vector<std::uint8_t> below(static_cast<std::size_t>(mesh.X.rows()), 0);
  for (Index f = 0; f < mesh.faces.size(); ++f) {
    for (const Index v : mesh.faces[f]) {
      below[v] = below[v] || !above[f] ? 1 : 0;
    }
  }
  Mesh result = mesh;
  std::map<Index, Index> copy;
  for (Index f = 0; f < mesh.faces.size(); ++f) {
    for (std::int64_t i = mesh.faces.first[f]; above[f] && i < mesh.faces.first[f + 1]; ++i) {
      Index& v = result.faces.corner[i];
      if (below[v]) {
        v = copy.try_emplace(v, static_cast<Index>(mesh.X.rows() + std::ssize(copy))).first->second;
      }
    }
  }
  result.X.conservativeResize(mesh.X.rows() + std::ssize(copy), 3);
  for (const auto& [v, w] : copy) {
    result.X.row(w) = mesh.X.row(v) + distance * normal.transpose();
  }
  return result;
}

Mesh with_slit(const Mesh& mesh, Index vertex, double width) {
  const State state(mesh);
  const CompressedRows rings = vertex_rings(state.topology);
  const std::span<const Index> ring = rings[vertex];
  const std::size_t half = ring.size() / 2;
  const Vec3 x = mesh.X.row(vertex), a = mesh.X.row(ring[0]), b = mesh.X.row(ring[half]);
  const Vec3 across = (b - a).cross(double_area_vector_at(vertex, mesh.X, state.topology));
  Mesh result = mesh;
  const auto copy = static_cast<Index>(mesh.X.rows());
  result.X.conservativeResize(copy + 1, 3);
  result.X.row(vertex) = x - width / 2 * across.normalized();
  result.X.row(copy) = x + width / 2 * across.normalized();
  for (std::size_t i = 0; i < half; ++i) {
    for (const Index t : state.topology.stars[vertex]) {
      const auto corners = mesh.faces[t];
      if (std::ranges::count(corners, ring[i]) + std::ranges::count(corners, ring[i + 1]) == 2) {
        std::ranges::replace(std::span(result.faces.corner).subspan(3 * t, 3), vertex, copy);
      }
    }
  }
  return result;
}

}  // namespace ibmfair::test
