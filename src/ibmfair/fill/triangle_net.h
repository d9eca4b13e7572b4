// Triangles with links to their neighbours, for local changes of the triangulation of a patch.
#pragma once

#include <array>
#include <vector>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// An edge of a triangle, given by the opposite corner. An edge with two triangles has two
/// NetEdges.
struct NetEdge {
  Index triangle = -1;
  int corner = 0;  ///< 0, 1 or 2
};

/// A manifold, coherently oriented set of triangles whose outer edges (the rim) never change.
class TriangleNet {
 public:
  /// Adds triangles, which become neighbours of each other but not of earlier triangles.
  /// Precondition: every edge of `F` has at most two triangles, which run along it in opposite
  /// directions.
  void append(const Triangles& F);

  Index size() const { return static_cast<Index>(corner_.size()); }
  const std::array<Index, 3>& operator[](Index t) const { return corner_[t]; }
  Triangles triangles() const;

  /// The edge `e` as an edge of the triangle on its other side; triangle is -1 at the rim.
  NetEdge other_side(NetEdge e) const { return across_[e.triangle][e.corner]; }

  /// The ends of an edge, in the direction of its triangle, and the opposite corner.
  Index start(NetEdge e) const { return corner_[e.triangle][(e.corner + 1) % 3]; }
  Index end(NetEdge e) const { return corner_[e.triangle][(e.corner + 2) % 3]; }
  Index opposite(NetEdge e) const { return corner_[e.triangle][e.corner]; }

  /// Whether `w` is a corner of a triangle around `v` that is reachable from `t` across edges at
  /// `v`. Precondition: `v` is a corner of `t`.
  bool joined(Index t, Index v, Index w) const;

  /// Replaces the edge, which is not on the rim, by the other diagonal of its two triangles.
  void flip(NetEdge e);

  /// Inserts vertex `v` on the edge, which is not on the rim. The two triangles become four; the
  /// two new triangles get the last numbers.
  void split(NetEdge e, Index v);

 private:
  int place(Index t, Index v) const;
  void join(NetEdge e, NetEdge o);
  void put(Index t, const std::array<Index, 3>& corners, const std::array<NetEdge, 3>& across);

  std::vector<std::array<Index, 3>> corner_;
  std::vector<std::array<NetEdge, 3>> across_;  // `other_side` of each edge
};

}  // namespace ibmfair
