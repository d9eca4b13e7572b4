// Moves vertices within the surface toward even spacing. Noise displaces vertices tangentially,
// too, which a curvature energy hardly sees. What noise has folded over the energy does see, but
// has no force to turn it back: the curvature of a hinge is largest where it is folded. There,
// where a vertex has no tangent plane but its neighbours have, the sweep moves it off whatever it
// is in. Where creases are to stay, it moves nothing off and no vertex across a crease, which step
// by step would round it.
#pragma once

#include "ibmfair/energy/unknowns.h"
#include "ibmfair/flow/mesh_parts.h"
#include "ibmfair/flow/ring_kernels.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Relaxes unknown interior vertices; those on a cut without orientation have no normal to project
/// with and stay.
class TangentialRelaxation {
 public:
  /// Refers to all that it is given.
  TangentialRelaxation(const Topology& topology, const RingGroups& rings, const Unknowns& unknowns,
                       const MeshParts& parts, bool keeps_creases);

  /// The moves of one sweep at `X` (one row per unknown, length): half way to the mean of the
  /// neighbours, projected off the area-weighted vertex normal unless the vertex sticks out; where
  /// creases are kept, off all directions in which the triangles there face.
  void moves(const Points& X, Points& move);

  /// The moves of the corners of needles, triangles with an angle of less than a degree; zero for
  /// all others. False, and nothing done, where no part of the mesh has any.
  bool moves_at_needles(const Points& X, Points& move);

 private:
  /// find_surroundings() for one vertex, whatever its ring.
  Surroundings look_around(const Points& X, Index v) const;

  /// Keeps the normal of v, and gives its move, as long as it does not stick out.
  void take(const Points& X, Index v, const Surroundings& around, Points& move);

  /// Whether vertex v has hardly a tangent plane, and its neighbours agree on one.
  bool sticks_out(Index v) const;

  /// What of a step is along all triangles at v, however little there is of one side of a crease.
  Vec3 along_creases(const Points& X, Index v, const Vec3& step) const;

  const Topology& topology_;
  const RingGroups& rings_;
  const Unknowns& unknowns_;
  const MeshParts& parts_;
  const bool keeps_creases_;
  Points normals_;  // #V x 3, of the rings' vertices: the sum of the triangles' double area vectors
  PerVertex left_;  // #V, of the rings' vertices: its share of the sum of their lengths
};

}  // namespace ibmfair
