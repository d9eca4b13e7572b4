// Fills a hole so that the sharp edges of the mesh that end at its rim go on through the patch.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ibmfair/fill/crease_network.h"
#include "ibmfair/fill/fill_holes.h"
#include "ibmfair/fill/patch_fairing.h"
#include "ibmfair/fill/rim_creases.h"

namespace ibmfair {

/// The creases at the rim of a hole, and how they go on.
struct ContinuedCreases {
  CreasedRim rim;         ///< without the ends that are not continued
  CreaseNetwork network;  ///< with a flaw if the creases cannot be continued
  std::int64_t ends = 0;  ///< the number of creases that end at the rim
};

/// Looks for creases at the rim of a triangulated hole; none if no crease ends there. A sharp edge
/// is one at which the surface turns by more than `angle` (radians). The creases of a patch of
/// several loops (holes that touch, islands) are not continued: the network then has a flaw.
std::optional<ContinuedCreases> look_for_creases(const Points& X, const Topology& topology,
                                                 const Patch& plain, double angle);

/// A patch of several sheets that meet at creases.
struct CreasedPatch {
  Patch patch;
  FairingReport fairing;   ///< of all sheets together
  bool refined = true;     ///< false if the limit of new vertices ended the refinement
  Index other_sheets = 0;  ///< sheets to be faired for which no stationary patch could be used
};

/// Fills the sheets between the creases one by one, each with its own directions along the rim, and
/// each by the first of the methods that `options` allow (fill/patch_methods.h) whose patch can be
/// used; directions are not smoothed. Precondition: the network has no flaw. Throws BadMesh if a
/// sheet cannot be filled, and OutOfMemory.
CreasedPatch fill_sheets(const Topology& topology, const Patch& plain,
                         const ContinuedCreases& creases, const FillOptions& options,
                         Index most_vertices);

}  // namespace ibmfair
