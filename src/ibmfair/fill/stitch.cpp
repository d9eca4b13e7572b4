#include "ibmfair/fill/stitch.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "ibmfair/mesh/geometry.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {
namespace {

/// A corner of a triangle or a vertex on one of its edges, with a bit for each edge it lies on.
struct OutlinePoint {
  EditedCorner corner;
  unsigned edges = 0;
};

double smallest_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double area = (b - a).cross(c - a).norm();
  double smallest = std::numbers::pi;
  for (const double dot : {(b - a).dot(c - a), (c - b).dot(a - b), (a - c).dot(b - c)}) {
    smallest = std::min(smallest, std::atan2(area, dot));
  }
  return smallest;
}

/// Cuts triangles off a triangle with further vertices on its edges, each time the one with the
/// largest smallest angle. Three vertices on one edge of the triangle are never a triangle: what
/// lies on one edge is known from the outline and not from rounded coordinates.
class TriangleCutter {
 public:
  TriangleCutter(const Points& X, std::vector<OutlinePoint> outline)
      : X_(X), outline_(std::move(outline)) {}

  void run(std::vector<std::vector<EditedCorner>>& pieces) {
    while (outline_.size() > 3) {
      const std::size_t ear = best_ear();
      pieces.push_back({at(ear + size() - 1).corner, at(ear).corner, at(ear + 1).corner});
      outline_.erase(outline_.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    pieces.push_back({at(0).corner, at(1).corner, at(2).corner});
  }

 private:
  std::size_t size() const { return outline_.size(); }
  const OutlinePoint& at(std::size_t i) const { return outline_[i % outline_.size()]; }

  std::size_t best_ear() const {
    std::size_t best = 0;
    double best_angle = -1;
    for (std::size_t i = 0; i < size(); ++i) {
      const OutlinePoint &a = at(i + size() - 1), &b = at(i), &c = at(i + 1);
      if ((a.edges & b.edges & c.edges) != 0 || others_are_on_one_edge(i)) {
        continue;
      }
      const double angle =
          smallest_angle(X_.row(a.corner.vertex), X_.row(b.corner.vertex), X_.row(c.corner.vertex));
      if (angle > best_angle) {
        best = i;
        best_angle = angle;
      }
    }
    return best;
  }

  bool others_are_on_one_edge(std::size_t tip) const {
    unsigned common = ~0U;
    for (std::size_t i = 0; i < size(); ++i) {
      common &= i == tip ? ~0U : outline_[i].edges;
    }
    return common != 0;
  }

  const Points& X_;
  std::vector<OutlinePoint> outline_;
};

/// Where vertices lie along the edges of a mesh.
class SplitEdges {
 public:
  SplitEdges(const Points& X, const std::vector<EdgeSplit>& splits)
      : X_(X), ends_(static_cast<std::size_t>(X.rows()), 0) {
    for (const EdgeSplit& split : splits) {
      std::vector<Index> back(split.vertices.rbegin(), split.vertices.rend());
      vertices_[{split.a, split.b}] = split.vertices;
      vertices_[{split.b, split.a}] = std::move(back);
      ends_[split.a] = ends_[split.b] = 1;
    }
  }

  /// Calls visit(corner) for each vertex on the edge from corner i to corner k of a face.
  template <class Visit>
  void each(std::span<const Index> face, Index i, Index k, const Visit& visit) const {
    const Index a = face[i], b = face[k];
    if (!ends_[a] || !ends_[b]) {
      return;
    }
    const auto found = vertices_.find({a, b});
    if (found == vertices_.end()) {
      return;
    }
    const Vec3 x = X_.row(a), d = X_.row(b) - X_.row(a);
    for (const Index v : found->second) {
      const double along = (Vec3(X_.row(v)) - x).dot(d) / d.squaredNorm();
      visit(EditedCorner{v, i, k, std::clamp(along, 0.0, 1.0)});
    }
  }

 private:
  const Points& X_;
  std::vector<std::uint8_t> ends_;  // #V, whether a split edge ends there
  std::map<std::pair<Index, Index>, std::vector<Index>> vertices_;
};

EditedCorner old_corner(std::span<const Index> face, Index i) {
  return {face[i], i, i, 0};
}

/// The corners of a face with the vertices on its edges.
std::vector<EditedCorner> with_vertices_on_edges(std::span<const Index> face,
                                                 const SplitEdges& edges) {
  std::vector<EditedCorner> corners;
  const auto n = static_cast<Index>(face.size());
  for (Index i = 0; i < n; ++i) {
    corners.push_back(old_corner(face, i));
    edges.each(face, i, (i + 1) % n, [&](const EditedCorner& c) { corners.push_back(c); });
  }
  return corners;
}

/// Whether a polygon has no corner twice, and is cut into triangles that have area.
bool can_be_cut(const Points& X, const std::vector<EditedCorner>& corners) {
  std::vector<Index> vertices, order;
  for (const EditedCorner& corner : corners) {
    order.push_back(static_cast<Index>(vertices.size()));
    vertices.push_back(corner.vertex);
  }
  Mesh polygon;
  polygon.X = X(vertices, Eigen::all);
  polygon.faces.add(order);
  std::sort(vertices.begin(), vertices.end());
  return std::adjacent_find(vertices.begin(), vertices.end()) == vertices.end() &&
         degenerate_triangles(polygon.X, triangulate(polygon).F).empty();
}

/// Cuts the face into triangles, and these at the vertices on their edges.
std::vector<std::vector<EditedCorner>> cut_into_triangles(const Points& X,
                                                          std::span<const Index> face,
                                                          const SplitEdges& edges) {
  Mesh polygon;
  std::vector<Index> order;
  for (std::size_t i = 0; i < face.size(); ++i) {
    order.push_back(static_cast<Index>(i));
  }
  polygon.X = X(std::vector<Index>(face.begin(), face.end()), Eigen::all);
  polygon.faces.add(order);
  const auto n = static_cast<Index>(face.size());
  std::vector<std::vector<EditedCorner>> pieces;
  const Triangles triangles = triangulate(polygon).F;
  for (const auto corners : triangles.rowwise()) {
    std::vector<OutlinePoint> outline;
    for (int i = 0; i < 3; ++i) {
      const Index from = corners[i], to = corners[(i + 1) % 3];
      outline.push_back({old_corner(face, from), 1U << i | 1U << (i + 2) % 3});
      if (to != (from + 1) % n) {
        continue;  // a diagonal
      }
      edges.each(face, from, to, [&](const EditedCorner& c) { outline.push_back({c, 1U << i}); });
    }
    TriangleCutter(X, std::move(outline)).run(pieces);
  }
  return pieces;
}

Weld weld_of(Index vertex_count, const Cracks& cracks) {
  Weld weld;
  auto merged = cracks.merged.begin();
  for (Index v = 0; v < vertex_count; ++v) {
    while (merged != cracks.merged.end() && (*merged)[1] < v) {
      ++merged;
    }
    if (merged != cracks.merged.end() && (*merged)[1] == v) {
      weld.vertex.push_back(weld.vertex[(*merged)[0]]);
    } else {
      weld.vertex.push_back(static_cast<Index>(weld.first.size()));
      weld.first.push_back(v);
    }
  }
  return weld;
}

}  // namespace

std::vector<FaceEdit> split_faces(const Mesh& mesh, const std::vector<EdgeSplit>& splits) {
  const SplitEdges edges(mesh.X, splits);
  std::vector<FaceEdit> edits;
  for (Index f = 0; f < mesh.faces.size(); ++f) {
    const std::span<const Index> face = mesh.faces[f];
    const auto n = static_cast<Index>(face.size());
    bool any = false;
    for (Index i = 0; i < n && !any; ++i) {
      edges.each(face, i, (i + 1) % n, [&](const EditedCorner&) { any = true; });
    }
    if (!any) {
      continue;
    }
    std::vector<EditedCorner> corners = with_vertices_on_edges(face, edges);
    if (n > 3 && can_be_cut(mesh.X, corners)) {
      edits.push_back({f, {std::move(corners)}});
    } else {
      edits.push_back({f, cut_into_triangles(mesh.X, face, edges)});
    }
  }
  return edits;
}

Mesh stitched(const Mesh& mesh, const Cracks& cracks) {
  Mesh result = with_edited_faces(mesh, split_faces(mesh, cracks.splits));
  std::vector<Index> stands_for(static_cast<std::size_t>(mesh.X.rows()), -1);
  for (const auto& [first, other] : cracks.merged) {
    stands_for[other] = first;
  }
  for (Index& v : result.faces.corner) {
    v = stands_for[v] >= 0 ? stands_for[v] : v;
  }
  return result;
}

EditedFile stitched(const MeshFile& file, const Cracks& cracks) {
  EditedFile result{file, {}};
  if (const auto edits = split_faces(file.mesh(), cracks.splits); !edits.empty()) {
    result = edit_faces(file, edits);
  }
  if (!cracks.merged.empty()) {
    result.file =
        CloseWeld(result.file, weld_of(static_cast<Index>(file.mesh().X.rows()), cracks)).file;
  }
  return result;
}

OpenParts open_parts(const Mesh& mesh) {
  const Topology topology = build_topology(mesh.X, triangulate(mesh).F);
  const std::vector<Hole> holes = find_holes(mesh.X, topology);
  OpenParts parts;
  parts.components = topology.component_count;
  parts.boundary_loops = static_cast<Index>(topology.boundary_loops.size());
  parts.holes = static_cast<Index>(
      std::ranges::count_if(holes, [](const Hole& hole) { return !hole.outer_border; }));
  parts.non_manifold_edges = static_cast<Index>(topology.defects.non_manifold_edges.size());
  parts.closed = parts.components > 0 && parts.boundary_loops == 0 && parts.non_manifold_edges == 0;
  return parts;
}

OpenParts open_parts_after(const Weld& weld, const Mesh& mesh) {
  Mesh welded = mesh;
  apply(weld, welded);
  return open_parts(welded);
}

}  // namespace ibmfair
