// Triangles that know their neighbours, for local changes of the triangulation of a patch.
#pragma once

#include <array>
#include <vector>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// An edge as one of the triangles beside it sees it: opposite to a corner.
struct NetEdge {
  Index triangle = -1;
  int corner = 0;  ///< 0, 1 or 2
};

/// A manifold, coherently oriented set of triangles whose outer edges (the rim) never change.
class TriangleNet {
 public:
  /// Adds triangles, which become neighbours of each other but not of earlier ones. Precondition:
  /// every edge of `F` has at most two triangles, which run along it in opposite directions.
  void append(const Triangles& F);

  Index size() const { return static_cast<Index>(corner_.size()); }
  const std::array<Index, 3>& operator[](Index t) const { return corner_[t]; }
  Triangles triangles() const;

  /// The edge `e` as the triangle on its other side has it; triangle -1 at the rim.
  NetEdge other_side(NetEdge e) const { return across_[e.triangle][e.corner]; }

  /// The ends of an edge in the order in which its triangle runs along it, and the corner opposite.
  Index start(NetEdge e) const { return corner_[e.triangle][(e.corner + 1) % 3]; }
  Index end(NetEdge e) const { return corner_[e.triangle][(e.corner + 2) % 3]; }
  Index opposite(NetEdge e) const { return corner_[e.triangle][e.corner]; }

  /// Whether any triangle in the fan of `v` at `t` has `w`, too.
  bool joined(Index t, Index v, Index w) const;

  /// Replaces the edge, which is not on the rim, by the other diagonal of its two triangles.
  void flip(NetEdge e);

  /// Puts vertex `v` on the edge, which is not on the rim: four triangles instead of two, of which
  /// the two new ones are the last.
  void split(NetEdge e, Index v);

 private:
  int place(Index t, Index v) const;
  void join(NetEdge e, NetEdge o);
  void put(Index t, const std::array<Index, 3>& corners, const std::array<NetEdge, 3>& across);

  std::vector<std::array<Index, 3>> corner_;
  std::vector<std::array<NetEdge, 3>> across_;  // the other side of each edge
};

}  // namespace ibmfair
