// The sharp edges of a mesh that end at the rim of a hole, and the smooth sheets between them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "ibmfair/fill/crease_curves.h"
#include "ibmfair/fill/patch.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// A line of sharp edges that ends at a vertex of the rim, or a vertex of the rim at which two
/// sheets meet at an angle.
struct CreaseEnd {
  std::size_t rim_edge = 0;  ///< the edge of Patch::rim that begins at the vertex
  CurveEnd curve;            ///< directed into the hole
  /// Two sheets meet here: [0] is the one whose part of the rim ends here, to the left of the
  /// crease as seen along it into the hole; the part of [1] begins here.
  std::array<Vec3, 2> normal{Vec3::Zero(), Vec3::Zero()};  ///< of each sheet, unit
  std::array<Index, 2> last{-1, -1};  ///< local: the neighbour on the rim of each sheet's fan
};

/// A plane, for sheets that are flat along the rim.
struct SheetPlane {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::Zero();  ///< unit
};

/// The part of the rim from one crease end to the next.
struct RimArc {
  std::vector<Index> triangles = {};  ///< of the mesh: those of the arc's sheet at its vertices
  Vec3 normal = Vec3::Zero();         ///< the mean of their unit normals by area, unit
  std::optional<SheetPlane> plane = {};
};

/// The rim of a hole, cut at the ends of creases.
struct CreasedRim {
  std::vector<CreaseEnd> ends;  ///< in the order of the rim
  std::vector<RimArc> arcs;     ///< arc i begins at end i; without ends, one arc is the whole rim
  /// Per rim edge: the rim runs along a crease here, and the triangle of the mesh at this edge does
  /// not belong to the sheet of the arc.
  std::vector<std::uint8_t> on_crease;

  bool has_creases() const { return !ends.empty() || std::ranges::count(on_crease, 1) > 0; }
};

/// Finds the creases at one loop of a patch's rim, which `rim` lists in order; `rim_edge` and
/// `on_crease` count its edges. `mesh_vertex`: Patch::mesh_vertex. A sharp edge is one at which the
/// surface turns by more than `angle` (radians). A line of sharp edges counts as a crease if it has
/// at least three edges, or leads to a place where several lines meet, to a corner of the line, or
/// to a boundary. Without creases the result has no ends and no edges on creases.
CreasedRim find_rim_creases(const Points& X, const Topology& topology,
                            const std::vector<RimEdge>& rim, const std::vector<Index>& mesh_vertex,
                            double angle);

/// Removes an end, so that the sheets on both sides of it count as one.
void remove_end(Index end, CreasedRim& rim);

}  // namespace ibmfair
