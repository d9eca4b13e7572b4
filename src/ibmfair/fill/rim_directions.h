// Directions at the rim of a hole that do not follow every roughness of the mesh.
#pragma once

#include <vector>

#include "ibmfair/fill/patch.h"

namespace ibmfair {

/// A move of a vertex of the second ring, from which the patch takes its directions.
struct RingShift {
  Index vertex;     ///< local number in the patch's surroundings
  Vec3 normal;      ///< of the mesh
  double distance;  ///< along the normal, length
};

/// The moves that put the second ring where smooth surfaces through a wider band of the mesh would
/// have it. A robust quadratic surface is fitted to the vertices within five rings of each vertex
/// of the second ring. The vertex gets the offset from the surface that its neighbours on the rim
/// have.
std::vector<RingShift> direction_shifts(const Points& X, const Topology& topology,
                                        const Patch& patch);

/// How much alike the distances of neighbouring shifts are: Moran's I about zero, that is, the mean
/// product over pairs of neighbours, divided by the mean square. Near 1 if the shape of the surface
/// makes the shifts, and small if noise makes them. 1 if there are no neighbours or no shifts.
double likeness_of_neighbors(const std::vector<RingShift>& shifts, const Topology& topology,
                             const Patch& patch);

/// Makes these moves in the patch's copy of the mesh. Vertices on the rim stay in place.
void smooth_directions(const std::vector<RingShift>& shifts, Patch& patch);

}  // namespace ibmfair
