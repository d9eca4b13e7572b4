// How far a step takes the mesh from where the Jacobian was built.
#pragma once

#include <vector>

#include "ibmfair/base/row4.h"
#include "ibmfair/energy/unknowns.h"
#include "ibmfair/flow/mesh_parts.h"
#include "ibmfair/flow/ring_groups.h"

namespace ibmfair {

/// A measure of what a step does to the triangles; 1 is as much as one time step should. It is the
/// larger of
///   roughness: the own part of the moves over the edge length, root mean square, over 0.15: noise
///              being removed is rough;
///   strain:    the difference of the moves along each edge over its length, root mean square, over
///              0.4: large smooth moves stretch and turn the surface without being rough.
/// Steps beyond let noise grow into volume; the two limits were chosen on noisy spheres, tori and
/// scans (tools/denoise_table) and on smooth shapes that change a lot (tools/figure9_table).
class Distortion {
 public:
  /// Refers to all that it is given.
  Distortion(const RingGroups& rings, const Unknowns& unknowns, const MeshParts& parts);

  /// That of `step` (one row per unknown, those of other parts included, length). `edge_length`
  /// (#V) is the mean length of the edges at each vertex. `own` becomes the part of each unknown's
  /// move that its neighbours do not share: the move minus the mean of theirs, held ones being 0.
  double of(const Points& step, const PerVertex& edge_length, Points& own);

 private:
  const RingGroups& rings_;
  const Unknowns& unknowns_;
  const MeshParts& parts_;
  double edges_ = 0;  // at the unknowns, those between two of them half
  std::vector<Row4> moves_;
};

}  // namespace ibmfair
