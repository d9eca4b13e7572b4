// The boundary loops of a mesh as a user sees them: holes to fill, and outer borders to leave.
#pragma once

#include <string>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// A boundary loop with its measures.
struct Hole {
  Index id = 0;                 ///< its place in Topology::boundary_loops: by smallest vertex
  std::vector<Index> loop;      ///< vertices in order; the mesh lies to the left
  double perimeter = 0;         ///< length
  double diameter = 0;          ///< of the bounding box (its diagonal), length
  bool closed = true;           ///< false where a non-manifold edge interrupts the loop
  bool simple = true;           ///< no vertex is met twice
  bool touches_itself = false;  ///< two of its vertices lie at one place: welding would join them
  Index component = 0;          ///< of the mesh
  bool outer_border = false;    ///< the edge of a sheet rather than a hole; see `border_share`
  /// The area that the loop spans (the length of its vector area) over the area of its component,
  /// for the longest loop of a component; 0 for the others. About 1 for a flat sheet, 1/2 for a
  /// half sphere, small for a hole in a closed surface.
  double border_share = 0;

  Index edges() const { return static_cast<Index>(loop.size()) - (closed ? 0 : 1); }
};

/// A loop with a larger `border_share` is an outer border: filling it would double the sheet.
inline constexpr double border_share_limit = 0.6;

/// All boundary loops of the mesh, in the order of their ids.
std::vector<Hole> find_holes(const Points& X, const Topology& topology);

/// Which holes to fill; limits that are not set let every hole pass.
struct HoleChoice {
  bool all = false;         ///< outer borders, too
  std::vector<Index> only;  ///< ids; empty for all. Chosen by name, an outer border is filled
  Index most_edges = 0;     ///< 0: no limit
  double longest_perimeter = 0, largest_diameter = 0;  ///< length; 0: no limit
};

/// Why the choice leaves `hole` out, one sentence without a full stop; empty where it is to be
/// filled.
std::string reason_to_skip(const Hole& hole, const HoleChoice& choice);

/// Throws BadOption for an id in `choice.only` that no hole has.
void require_known_holes(const std::vector<Hole>& holes, const HoleChoice& choice);

/// Splits a loop where it meets a vertex twice: closed polygons without repeated corners. Filling
/// them closes the vertex's gaps one by one, so that it ends as an inner vertex of a surface.
std::vector<std::vector<Index>> simple_loops(const std::vector<Index>& loop);

}  // namespace ibmfair
