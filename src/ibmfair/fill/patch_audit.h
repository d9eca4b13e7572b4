// The quality of a finished patch: how it bends at the seam to the mesh, and its foldovers. Also
// finds the part of the mesh that is nearest to each triangle of the patch.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/fill/patch.h"

namespace ibmfair {

/// By how much hinges (edges with their two triangles) differ from flat, radians; 0 for flat.
struct Bends {
  double median = 0, largest = 0;
};

struct SeamAudit {
  Bends seam;          ///< at the edges between patch and mesh
  Bends surroundings;  ///< at the edges of the mesh at rim vertices, for comparison
  /// Foldovers in the patch and at the seam, except at Patch::creases (flow/steps/folds.h).
  Index folds = 0;
};

/// How large a patch, or a part of it, is.
struct PatchSize {
  double diameter = 0;  ///< diagonal of the bounding box, length
  double area = 0;      ///< length^2
};

/// For each triangle of the patch, the number of the nearest rim edge; distances are counted in
/// triangles, on the same side of creases.
std::vector<Index> nearest_rim_edges(const Patch& patch);

/// Audits the triangles whose nearest rim edge is flagged in `chosen` (one flag per rim edge).
/// `nearest`: the result of nearest_rim_edges.
SeamAudit audit_seam(const Patch& patch, const std::vector<Index>& nearest,
                     const std::vector<std::uint8_t>& chosen);

/// The size of the same triangles.
PatchSize audit_size(const Patch& patch, const std::vector<Index>& nearest,
                     const std::vector<std::uint8_t>& chosen);

}  // namespace ibmfair
