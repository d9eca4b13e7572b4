// Lines of sharp edges on a mesh.
#pragma once

#include <vector>

#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// A line of sharp edges, from its first vertex on.
struct SharpLine {
  std::vector<Index> vertices;
  /// Whether the line goes on, or ends where a crease can end: where several lines meet, at a
  /// corner of the line, or at a boundary. Otherwise it ends within a smooth part of the surface.
  bool ends_well = true;
};

class SharpLines {
 public:
  /// An edge is sharp if the normals of its two triangles differ by more than `angle` (radians).
  /// The mesh must outlive this object.
  SharpLines(const Points& X, const Topology& topology, double angle)
      : X_(X), topology_(topology), angle_(angle) {}

  /// The triangle on the other side of the edge from v to w of triangle t; -1 unless the edge has
  /// exactly two triangles.
  Index beyond(Index t, Index v, Index w) const;

  /// Whether the surface turns by more than the angle between two triangles.
  bool turns(Index t, Index u) const;

  /// Follows the sharp edge from v to w, and those that continue it, for a few edges.
  SharpLine follow(Index v, Index w) const;

 private:
  std::vector<Index> sharp_neighbors(Index v) const;

  const Points& X_;
  const Topology& topology_;
  double angle_;
};

/// The angle at which edges count as sharp, as the mesh suggests, radians: at least 25 degrees, and
/// more than the edges of a rough mesh turn by chance. 0, so that no edge counts as sharp, if this
/// would be more than a right angle, or if the sharp edges do not form lines: at most 10 % of the
/// interior vertices that have sharp edges may have a single one. On the meshes of machine parts 0
/// to 7 % have a single one, on scans 15 to 65 %.
double sharp_angle_of(const Points& X, const Topology& topology);

}  // namespace ibmfair
