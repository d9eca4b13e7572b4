#include "ibmfair/shapes/subdivide.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"

namespace ibmfair {

namespace {

/// The split edges with the numbers of their midpoints, listed at the smaller of the two vertices.
/// Numbers are given in the order of insertion, so that the result does not depend on a hash.
class Midpoints {
 public:
  explicit Midpoints(Index vertex_count)
      : vertex_count_(vertex_count), first_(static_cast<std::size_t>(vertex_count), none) {}

  /// The midpoint of edge a b, or `none`.
  Index find(Index a, Index b) const {
    Index e = first_[std::min(a, b)];
    while (e != none && edges_[e].larger != std::max(a, b)) {
      e = edges_[e].next;
    }
    return e == none ? none : vertex_count_ + e;
  }

  void add(Index a, Index b) {
    if (find(a, b) == none) {
      Index& first = first_[std::min(a, b)];
      edges_.push_back({std::min(a, b), std::max(a, b), first});
      first = static_cast<Index>(edges_.size()) - 1;
    }
  }

  /// X followed by the midpoints.
  Points positions(const Points& X) const {
    Points result(X.rows() + static_cast<Eigen::Index>(edges_.size()), 3);
    result.topRows(X.rows()) = X;
    Eigen::Index row = X.rows();
    for (const Edge& edge : edges_) {
      result.row(row++) = 0.5 * (X.row(edge.smaller) + X.row(edge.larger));
    }
    return result;
  }

  static constexpr Index none = -1;

 private:
  struct Edge {
    Index smaller;
    Index larger;
    Index next;  // next edge with the same smaller vertex
  };
  Index vertex_count_;
  std::vector<Index> first_;
  std::vector<Edge> edges_;
};

using Triple = std::array<Index, 3>;

Triple corners_of(const Triangles& F, Eigen::Index f) {
  return {F(f, 0), F(f, 1), F(f, 2)};
}

// The midpoints of the edges that start at corner 0, 1 and 2.
Triple midpoints_of(const Midpoints& midpoints, const Triple& t) {
  return {midpoints.find(t[0], t[1]), midpoints.find(t[1], t[2]), midpoints.find(t[2], t[0])};
}

int split_count(const Triple& middle) {
  return 3 - static_cast<int>(std::count(middle.begin(), middle.end(), Midpoints::none));
}

// Marks triangles until every unmarked triangle has at most one split edge.
void close(const Triangles& F, std::vector<std::uint8_t>& marked, Midpoints& midpoints) {
  bool changed = true;
  while (changed) {
    changed = false;
    for (Eigen::Index f = 0; f < F.rows(); ++f) {
      const Triple t = corners_of(F, f);
      std::uint8_t& mark = marked[f];
      if (mark == 0 && split_count(midpoints_of(midpoints, t)) >= 2) {
        mark = 1;
        changed = true;
      }
      if (mark != 0) {
        midpoints.add(t[0], t[1]);
        midpoints.add(t[1], t[2]);
        midpoints.add(t[2], t[0]);
      }
    }
  }
}

void append_children(const Triple& t, const Triple& m, std::vector<Triple>& out) {
  const int splits = split_count(m);
  if (splits == 0) {
    out.push_back(t);
  } else if (splits == 1) {
    const auto i = static_cast<std::size_t>(
        std::find_if(m.begin(), m.end(), [](Index v) { return v != Midpoints::none; }) - m.begin());
    const Index apex = t[(i + 2) % 3];
    out.push_back({t[i], m[i], apex});
    out.push_back({m[i], t[(i + 1) % 3], apex});
  } else {
    out.push_back({t[0], m[0], m[2]});
    out.push_back({m[0], t[1], m[1]});
    out.push_back({m[2], m[1], t[2]});
    out.push_back(m);
  }
}

}  // namespace

TriangleMesh split_triangles(const TriangleMesh& mesh, std::vector<std::uint8_t> marked) {
  require_shape_size(static_cast<double>(mesh.F.rows()) +
                     3.0 * static_cast<double>(std::count(marked.begin(), marked.end(), 1)));
  Midpoints midpoints(static_cast<Index>(mesh.X.rows()));
  close(mesh.F, marked, midpoints);
  std::vector<Triple> children;
  for (Eigen::Index f = 0; f < mesh.F.rows(); ++f) {
    const Triple t = corners_of(mesh.F, f);
    append_children(t, midpoints_of(midpoints, t), children);
  }
  TriangleMesh result{midpoints.positions(mesh.X), {}};
  result.F = Eigen::Map<const Triangles>(children.front().data(),
                                         static_cast<Eigen::Index>(children.size()), 3);
  return result;
}

TriangleMesh split_all_triangles(const TriangleMesh& mesh) {
  return split_triangles(mesh,
                         std::vector<std::uint8_t>(static_cast<std::size_t>(mesh.F.rows()), 1));
}

void require_shape_size(double face_count) {
  if (!(face_count <= static_cast<double>(largest_shape))) {
    throw BadOption(
        fmt::format("the shape would have {:.4g} faces, and at most {} can be made; "
                    "smaller numbers for --subdivide, --rows or --columns make fewer",
                    face_count, largest_shape));
  }
}

}  // namespace ibmfair
