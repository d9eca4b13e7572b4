// What became of a patch: its seam, its folds, and the part of the mesh that each triangle is
// nearest to.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/fill/patch.h"

namespace ibmfair {

/// How far hinges are from flat, radians: 0 where flat.
struct Bends {
  double median = 0, largest = 0;
};

struct SeamAudit {
  Bends seam;          ///< of the edges between patch and mesh
  Bends surroundings;  ///< of the mesh's own edges at vertices of the rim, for comparison
  Index folds = 0;     ///< hinges of the patch and the seam that are folded over (flow/folds.h)
};

/// For each triangle of the patch the rim edge nearest to it, counted in triangles.
std::vector<Index> nearest_rim_edges(const Patch& patch);

/// Judges the part of the patch that belongs to the rim edges for which `chosen` (#rim) is set;
/// `nearest` as above.
SeamAudit audit_seam(const Patch& patch, const std::vector<Index>& nearest,
                     const std::vector<std::uint8_t>& chosen);

}  // namespace ibmfair
