#include "ibmfair/fill/patch.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/fill/fins.h"
#include "ibmfair/fill/hole_triangulation.h"
#include "ibmfair/mesh/corners.h"

namespace ibmfair {
namespace {

constexpr double line_width = 1e-9;  // of a polygon that has no area, relative to its length

void make_unique(std::vector<Index>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

std::vector<Index> triangles_at(const Topology& topology, const std::vector<Index>& vertices) {
  std::vector<Index> result;
  for (const Index v : vertices) {
    result.insert(result.end(), topology.stars[v].begin(), topology.stars[v].end());
  }
  make_unique(result);
  return result;
}

/// Converts numbers of mesh vertices to local numbers.
class Numbering {
 public:
  explicit Numbering(std::vector<Index> vertices) : vertices_(std::move(vertices)) {}
  Index operator()(Index mesh_vertex) const {
    const auto it = std::lower_bound(vertices_.begin(), vertices_.end(), mesh_vertex);
    return static_cast<Index>(it - vertices_.begin());
  }
  const std::vector<Index>& vertices() const { return vertices_; }

 private:
  std::vector<Index> vertices_;  // sorted
};

Triangles renumbered(const Topology& topology, const std::vector<Index>& triangles,
                     const Numbering& local) {
  Triangles F(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      F(static_cast<Eigen::Index>(i), k) = local(topology.F(triangles[i], k));
    }
  }
  return F;
}

/// The one triangle of the mesh at a boundary edge.
Index triangle_behind(const Topology& topology, Index a, Index b) {
  for (const Index t : topology.stars[a]) {
    const auto x = topology.F.row(t);
    if ((x.array() == b).any()) {
      return t;
    }
  }
  throw BadMesh(fmt::format("vertices {} and {} are not joined", a, b));
}

/// The polygon that a disc fills: the loop in reverse order.
struct Polygon {
  std::vector<Index> corners;         // mesh vertices
  std::vector<Index> mesh_triangles;  // the mesh triangle at the edge from each corner to the next
};

Polygon polygon_of(const Topology& topology, const std::vector<Index>& loop) {
  Polygon polygon;
  polygon.corners.assign(loop.rbegin(), loop.rend());
  for (std::size_t i = 0; i < loop.size(); ++i) {
    polygon.mesh_triangles.push_back(
        triangle_behind(topology, polygon.corners[i], polygon.corners[(i + 1) % loop.size()]));
  }
  return polygon;
}

/// The reason why a polygon (#L x 3) has no triangulation.
std::string cause_of_failure(const Points& loop) {
  const Points from_first = loop.rowwise() - loop.row(0);
  // Triangulations are compared by products of four lengths.
  const double size = std::pow(from_first.cwiseAbs().maxCoeff(), 4);
  if (!std::isnormal(size)) {
    return size > 0 ? "its edges are too long or too short to compute with"
                    : "its vertices lie at one place, or too close together to compute with";
  }
  Eigen::Index farthest = 0;
  const double length = std::sqrt(from_first.rowwise().squaredNorm().maxCoeff(&farthest));
  const Vec3 along = from_first.row(farthest).transpose() / length;
  double width = 0;
  for (const auto d : from_first.rowwise()) {
    width = std::max(width, (d.transpose() - along * along.dot(d)).norm());
  }
  if (!(width > line_width * length)) {
    return "its vertices lie on one line, so that it has no area";
  }
  if (loop.rows() > longest_searched_loop) {
    return fmt::format(
        "its Delaunay triangulation has no triangulation of its rim, and with {} edges it is too "
        "long for a search among all triangulations",
        loop.rows());
  }
  return "every triangulation of its rim has a triangle without area";
}

Triangles triangulated(const Points& X, const Topology& topology, const Polygon& polygon) {
  const std::size_t n = polygon.corners.size();
  Points apex(static_cast<Eigen::Index>(n), 3);
  for (std::size_t i = 0; i < n; ++i) {
    apex.row(static_cast<Eigen::Index>(i)) = X.row(opposite_vertex(
        topology.F, polygon.mesh_triangles[i], polygon.corners[i], polygon.corners[(i + 1) % n]));
  }
  Triangles F = triangulate_hole(X(polygon.corners, Eigen::all), apex);
  if (F.rows() != static_cast<Eigen::Index>(n) - 2) {
    throw BadMesh(cause_of_failure(X(polygon.corners, Eigen::all)));
  }
  if (n == 3) {
    const auto behind = topology.F.row(polygon.mesh_triangles[0]);
    if (std::all_of(polygon.corners.begin(), polygon.corners.end(),
                    [&](Index v) { return (behind.array() == v).any(); })) {
      throw BadMesh("it is the border of a single triangle, which would be covered twice");
    }
  }
  return F;
}

Triangles triangulated_ring(const Points& X, const Polygon& outer, const Polygon& inner,
                            bool tube) {
  const Points one = X(outer.corners, Eigen::all), other = X(inner.corners, Eigen::all);
  Triangles F = tube ? triangulate_tube(one, other) : triangulate_ring(one, other);
  if (F.rows() == 0) {
    throw BadMesh("the two loops to join have too many edges");
  }
  return F;
}

/// Marks as taken the mesh edges between rim vertices, and diagonals that two discs have in common.
void mark_taken(Patch& patch, const std::vector<std::uint8_t>& on_rim,
                const std::vector<Triangles>& discs) {
  const auto each_edge = [&](const Triangles& F, const auto& visit) {
    for (const auto x : F.rowwise()) {
      for (int i = 0; i < 3; ++i) {
        visit(x[i], x[(i + 1) % 3]);
      }
    }
  };
  each_edge(patch.surroundings, [&](Index a, Index b) {
    if (on_rim[a] && on_rim[b]) {
      patch.taken.add(a, b);
    }
  });
  EdgeSet earlier;
  for (const Triangles& disc : discs) {
    each_edge(disc, [&](Index a, Index b) {
      if (earlier.contains(a, b)) {
        patch.taken.add(a, b);
      }
    });
    each_edge(disc, [&](Index a, Index b) { earlier.add(a, b); });
  }
}

/// Sets the spacing to the mean length of the rim edges at each rim vertex. Mesh edges that lead
/// away from the rim do not count: if the mesh has long thin triangles, these edges would make the
/// patch too coarse to follow the rim.
void measure_spacing(Patch& patch) {
  std::vector<double> count(patch.mesh_vertex.size(), 0);
  patch.spacing.assign(count.size(), 0);
  for (const RimEdge& edge : patch.rim) {
    const double length = (patch.X.row(edge.a) - patch.X.row(edge.b)).norm();
    for (const Index v : {edge.a, edge.b}) {
      patch.spacing[v] += length;
      count[v] += 1;
    }
  }
  for (std::size_t v = 0; v < count.size(); ++v) {
    patch.spacing[v] /= std::max(count[v], 1.0);
  }
  patch.wanted = patch.spacing;
}

}  // namespace

Triangles all_triangles(const Patch& patch) {
  Triangles F(patch.surroundings.rows() + patch.net.size(), 3);
  F << patch.surroundings, patch.net.triangles();
  return F;
}

double edges_along_rim(const Patch& patch) {
  if (!(patch.inner_spacing > 0)) {
    return static_cast<double>(patch.rim.size());
  }
  double length = 0;
  for (const RimEdge& edge : patch.rim) {
    length += (patch.X.row(edge.a) - patch.X.row(edge.b)).norm();
  }
  return length / patch.inner_spacing;
}

std::vector<Index> grown_by_ring(const Topology& topology, const std::vector<Index>& vertices) {
  std::vector<Index> result = vertices;
  for (const Index v : vertices) {
    for (const Index t : topology.stars[v]) {
      result.insert(result.end(), topology.F.row(t).begin(), topology.F.row(t).end());
    }
  }
  make_unique(result);
  return result;
}

std::vector<Index> vertices_around_rim(const Topology& topology, const Patch& patch, int rings) {
  std::vector<Index> vertices;
  for (const RimEdge& edge : patch.rim) {
    vertices.push_back(patch.mesh_vertex[edge.a]);
  }
  for (int ring = 0; ring < rings; ++ring) {
    vertices = grown_by_ring(topology, vertices);
  }
  return vertices;
}

double mean_rim_edge_length(const Patch& patch) {
  double sum = 0;
  for (const RimEdge& edge : patch.rim) {
    sum += (patch.X.row(edge.a) - patch.X.row(edge.b)).norm();
  }
  return sum / static_cast<double>(patch.rim.size());
}

Patch cut_patch(const Points& X, const Topology& topology,
                const std::vector<PatchOutline>& outlines, int free_rings) {
  std::vector<Index> rim;
  for (const PatchOutline& outline : outlines) {
    rim.insert(rim.end(), outline.loop.begin(), outline.loop.end());
    rim.insert(rim.end(), outline.island.begin(), outline.island.end());
  }
  make_unique(rim);
  std::vector<Index> free = free_rings > 0 ? rim : std::vector<Index>{};
  for (int ring = 1; ring < free_rings; ++ring) {
    free = grown_by_ring(topology, free);
  }
  const std::vector<Index> centres = free_rings > 0 ? grown_by_ring(topology, free) : rim;
  const Numbering local(grown_by_ring(topology, centres));

  Patch patch;
  patch.mesh_vertex = local.vertices();
  patch.X = X(patch.mesh_vertex, Eigen::all);
  const std::vector<Index> around = triangles_at(topology, centres);
  patch.surroundings = renumbered(topology, around, local);
  patch.own_from = patch.size();
  patch.free.assign(patch.mesh_vertex.size(), 0);
  for (const Index v : free) {
    patch.free[local(v)] = topology.defective[v] ? 0 : 1;
  }
  std::vector<std::uint8_t> on_rim(patch.mesh_vertex.size(), 0);
  for (const Index v : rim) {
    on_rim[local(v)] = 1;
  }
  std::vector<Triangles> discs;
  for (const PatchOutline& outline : outlines) {
    std::vector<Polygon> polygons{polygon_of(topology, outline.loop)};
    if (!outline.island.empty()) {
      polygons.push_back(polygon_of(topology, outline.island));
    }
    std::vector<Index> corners;
    for (const Polygon& polygon : polygons) {
      corners.insert(corners.end(), polygon.corners.begin(), polygon.corners.end());
      const std::size_t n = polygon.corners.size();
      for (std::size_t i = 0; i < n; ++i) {
        patch.rim.push_back({local(polygon.corners[i]), local(polygon.corners[(i + 1) % n]),
                             polygon.mesh_triangles[i]});
      }
    }
    discs.push_back(polygons.size() == 1
                        ? triangulated(X, topology, polygons[0])
                        : triangulated_ring(X, polygons[0], polygons[1], outline.tube));
    for (Index& corner : discs.back().reshaped()) {
      corner = local(corners[corner]);
    }
    patch.net.append(discs.back());
  }
  patch.one_disc = discs.size() == 1;
  mark_taken(patch, on_rim, discs);
  measure_spacing(patch);
  leave_out_protruding(patch, around);
  return patch;
}

Patch cut_region(const Points& X, const Topology& topology, const std::vector<Index>& region) {
  std::vector<std::uint8_t> inside(static_cast<std::size_t>(topology.vertex_count), 0);
  for (const Index v : region) {
    inside[v] = 1;
  }
  const std::vector<Index> own = triangles_at(topology, region);
  const std::vector<Index> centres = grown_by_ring(topology, region);
  std::vector<Index> all = triangles_at(topology, centres);
  const Numbering local(grown_by_ring(topology, centres));

  Patch patch;
  patch.mesh_vertex = local.vertices();
  patch.X = X(patch.mesh_vertex, Eigen::all);
  patch.own_from = patch.size();
  patch.net.append(renumbered(topology, own, local));
  std::vector<Index> others;
  std::set_difference(all.begin(), all.end(), own.begin(), own.end(), std::back_inserter(others));
  patch.surroundings = renumbered(topology, others, local);
  for (const Index v : patch.mesh_vertex) {
    patch.free.push_back(inside[v] && !topology.defective[v] ? 1 : 0);
  }
  return patch;
}

}  // namespace ibmfair
