// What the mesh around a hole is like, from which the method for the patch follows.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "ibmfair/fill/patch.h"
#include "ibmfair/fill/rim_directions.h"

namespace ibmfair {

enum class SurroundingsKind : std::uint8_t {
  smooth,  ///< a smooth surface, finely meshed
  noisy,   ///< rough, and the roughness of neighbouring vertices has nothing in common
  shaped,  ///< rough because the surface has details of the size of the triangles
};

/// "smooth", "noisy", "shaped"
std::string_view name_of(SurroundingsKind kind);

struct RimSurroundings {
  SurroundingsKind kind = SurroundingsKind::smooth;
  /// The median difference of a vertex's mean curvature (the sum of both principal curvatures) from
  /// the mean over its neighbours, times the mean length of the rim's edges. It is taken over the
  /// interior vertices within three rings of the rim. About four times the noise, if the noise is
  /// given in edge lengths.
  double roughness = 0;
  /// Whether a hinge within three rings of the rim turns by more than 60 degrees, and whether three
  /// in ten are flat, which noise does not leave. Not computed for smooth surroundings.
  bool has_creases = false, has_planes = false;
  /// How much alike neighbours on the second ring are moved if directions are smoothed
  /// (fill/rim_directions.h). Not computed for smooth surroundings.
  std::optional<double> likeness = {};
  std::vector<RingShift> shifts = {};  ///< direction_shifts, from which `likeness` follows
};

/// Looks at the mesh around the patch's rim. None if no vertex there has an interior neighbour.
std::optional<RimSurroundings> look_around(const Points& X, const Topology& topology,
                                           const Patch& patch);

}  // namespace ibmfair
