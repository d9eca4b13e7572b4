// The boundary loops of a mesh as a user sees them: holes to fill, and outer borders to leave.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// What a boundary loop is: a hole; a crack, whose edges all lie on other boundary edges; a crack
/// along some of its edges; or a side of a slit, which is a hole so narrow that its sides run along
/// each other. See fill/cracks.h and fill/slits.h.
enum class LoopKind : std::uint8_t { hole, crack, partial_crack, slit };

/// "hole", "crack", "partial crack", "slit"
std::string_view name_of(LoopKind kind);

/// What a boundary loop has of a crack.
struct LoopCrack {
  LoopKind kind = LoopKind::hole;
  Index edges = 0;        ///< edges of the loop that lie completely on other boundary edges
  bool exact = true;      ///< the ends of edges that lie on each other have equal coordinates
  Index t_junctions = 0;  ///< vertices that lie inside an edge of the loop without splitting it
  /// One of these vertices, and the ends of this edge; if there is none, a vertex of the loop that
  /// lies inside an edge of another loop; else -1.
  std::array<Index, 3> t_junction{-1, -1, -1};
  double width = 0;  ///< of a slit: the largest distance across it, length
};

/// A boundary loop with its measures.
struct Hole {
  Index id = 0;                 ///< holes are numbered by their smallest vertex
  std::vector<Index> loop;      ///< vertices in order; the mesh lies to the left
  double perimeter = 0;         ///< length
  double diameter = 0;          ///< diagonal of the bounding box, length
  bool closed = true;           ///< false if a non-manifold edge interrupts the loop
  bool simple = true;           ///< no vertex occurs twice
  bool touches_itself = false;  ///< two vertices have equal coordinates: welding would join them
  LoopCrack crack;
  Index component = 0;        ///< connected component of the mesh
  bool outer_border = false;  ///< the edge of a sheet rather than a hole; see `border_share`
  /// For the longest loop of a component, the area that the loop spans (the length of its vector
  /// area) over the area of the component; 0 for all other loops. About 1 for a flat sheet, 1/2 for
  /// a half sphere, small for a hole in a closed surface.
  double border_share = 0;

  Index edges() const { return static_cast<Index>(loop.size()) - (closed ? 0 : 1); }
};

/// A loop with a larger `border_share` is an outer border: filling it would double the sheet.
inline constexpr double border_share_limit = 0.6;

/// All boundary loops of the mesh, in the order of their ids. Fins (fill/fins.h) do not count: they
/// neither have nor interrupt boundary loops.
std::vector<Hole> find_holes(const Points& X, const Topology& topology);

/// Which holes to fill. A limit of 0 selects every hole.
struct HoleChoice {
  bool all = false;         ///< fill outer borders, too
  std::vector<Index> only;  ///< ids, even of outer borders; empty: choose among all holes
  std::vector<std::array<Index, 2>> bridges = {};  ///< pairs of ids to join by tubes (bridges.h)
  Index most_edges = 0;                            ///< 0: no limit
  double longest_perimeter = 0, largest_diameter = 0;  ///< length; 0: no limit
};

/// The reason why `choice` leaves `hole` out, one sentence without a full stop; empty if the hole
/// is to be filled.
std::string reason_to_skip(const Hole& hole, const HoleChoice& choice);

/// What kind of crack or slit the loop is, and what closes it, one sentence without a full stop;
/// empty for a hole.
std::string describe_crack(const Hole& hole);

/// Throws BadOption for an id in `choice.only` or `choice.bridges` that no hole has.
void require_known_holes(const std::vector<Hole>& holes, const HoleChoice& choice);

/// Splits a loop at every vertex that occurs twice, into closed polygons without repeated corners.
/// Filling these polygons closes the gaps around such a vertex one by one, so that it ends up as an
/// interior vertex of a surface.
std::vector<std::vector<Index>> simple_loops(const std::vector<Index>& loop);

}  // namespace ibmfair
