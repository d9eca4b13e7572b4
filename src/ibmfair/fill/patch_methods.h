// The methods by which a patch can be made, in the order in which they are tried.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ibmfair/fill/fill_holes.h"

namespace ibmfair {

enum class PatchKind : std::uint8_t {
  creased,     ///< of several sheets of stationary bending energy (fill/continued_creases.h)
  stationary,  ///< of stationary bending energy
  linear,      ///< by linear fairing
  least_area,  ///< a minimal surface
  unfaired,    ///< triangulated and refined only
  plain,       ///< triangulated only
};

struct PatchMethod {
  std::string name;  ///< as reports state it
  PatchKind kind = PatchKind::stationary;
  FairingOptions fairing = {};
  /// The mesh is smoothed around the rim before the patch takes its direction from there. Only the
  /// patch sees the smoothed mesh.
  bool smooth_directions = false;
  /// The faired patch is moved to continue the curvature of the mesh around its hole.
  bool continue_curvature = false;
  /// Of linear fairing, each time refined and with the lengths and angles of the previous result.
  int repetitions = 0;
};

/// The options with the Laplacian and the directions that suit such surroundings. Smooth:
/// intrinsic-delaunay, the most exact member. Noisy: the same member with smoothed directions,
/// unless vertices of the mesh may move. Shaped: intrinsic-delaunay with continued curvature; where
/// the surroundings are too rough for that, or vertices of the mesh may move, crouzeix-raviart,
/// which is usually nearer to what is missing in the mesh of a scan than the other members.
FillOptions options_for(const RimSurroundings& surroundings, FillOptions options);

/// The methods that the options allow. The first is the one that they ask for; the others are for
/// holes in which it fails. The last one adds no vertices.
std::vector<PatchMethod> patch_methods(const FillOptions& options);

}  // namespace ibmfair
