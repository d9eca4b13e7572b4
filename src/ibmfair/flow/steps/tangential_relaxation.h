// Moves vertices within the surface toward even spacing. Noise also displaces vertices
// tangentially, which hardly changes a curvature energy. Triangles that noise has folded over do
// have a large energy, but no force unfolds them: the curvature of a folded hinge is at its
// maximum. A vertex of such triangles has no tangent plane while its neighbours have one ("sticks
// out"), and is moved toward its neighbours without projection. If creases are kept, vertices that
// stick out stay in their surface too, and no vertex moves across a crease, which would gradually
// round the crease.
#pragma once

#include "ibmfair/flow/steps/flow_problem.h"
#include "ibmfair/flow/steps/ring_kernels.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Relaxes unknown interior vertices. Vertices on the cut of a mesh that is not orientable have no
/// normal to project off and stay.
class TangentialRelaxation {
 public:
  /// Both must outlive this object. Creases are kept if the problem's options keep sharp
  /// hinges, or relax along creases only.
  TangentialRelaxation(const FlowProblem& problem, const RingGroups& rings);

  /// The moves of one sweep at `X` (one row per unknown, length): half way to the mean of the
  /// neighbours, projected off the area-weighted vertex normal unless the vertex sticks out. If
  /// creases are kept, moves are also projected off the directions across a crease.
  void moves(const Points& X, Points& move);

  /// The moves of the corners of needles (triangles with an angle of less than one degree); zero
  /// for all other vertices. Returns false, with `move` unchanged, if no part of the mesh has
  /// needles.
  bool moves_at_needles(const Points& X, Points& move);

 private:
  /// find_surroundings() for one vertex, with a ring of any kind.
  Surroundings look_around(const Points& X, Index v) const;

  /// Stores the normal of v, and computes its move under the assumption that v does not stick out.
  void take(const Points& X, Index v, const Surroundings& around, Points& move);

  /// Whether the triangles at v hardly have a common tangent plane, while its neighbours have one.
  bool sticks_out(Index v) const;

  /// The part of a step that is parallel to all triangles at v, even if the triangles on one side
  /// of a crease are small.
  Vec3 along_creases(const Points& X, Index v, const Vec3& step) const;

  const Topology& topology_;
  const Unknowns& unknowns_;
  const MeshParts& parts_;
  const RingGroups& rings_;
  const bool keeps_creases_;
  const double crease_;  // RelaxationTuning::crease
  Points normals_;       // #V x 3, Surroundings::normal.xyz of the vertices in `rings`
  PerVertex left_;       // #V, Surroundings::normal.w of the vertices in `rings`
};

}  // namespace ibmfair
