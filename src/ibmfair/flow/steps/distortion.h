// Measures how far a step takes the mesh from the state at which the Jacobian was built.
#pragma once

#include <vector>

#include "ibmfair/base/row4.h"
#include "ibmfair/energy/unknowns.h"
#include "ibmfair/flow/mesh_parts.h"
#include "ibmfair/flow/steps/ring_groups.h"

namespace ibmfair {

/// A measure of how much a step distorts the triangles; a time step should distort by at most 1.
/// The measure is the larger of
///   roughness: the root mean square of the own part of each move (the part that neighbours do not
///              share: the umbrella Laplacian of the moves, with the opposite sign) over the edge
///              length, divided by its limit. Removing noise is rough;
///   strain:    the root mean square, over the edges, of the difference of the moves of both ends
///              over the edge length, divided by its limit. Large smooth moves stretch and turn the
///              surface without being rough.
/// With larger steps, noise grows into volume. The limits are in DistortionTuning.
class Distortion {
 public:
  /// All arguments must outlive this object.
  Distortion(const RingGroups& rings, const Unknowns& unknowns, const MeshParts& parts);

  /// The distortion of `step` (length; one row per unknown, including the unknowns of other parts).
  /// `edge_length` (#V): the mean length of the edges at each vertex. Writes to `own` the part of
  /// each move that the neighbours do not share: the move minus the mean of the neighbours' moves,
  /// which are 0 for fixed vertices.
  double of(const Points& step, const PerVertex& edge_length, Points& own);

 private:
  const RingGroups& rings_;
  const Unknowns& unknowns_;
  const MeshParts& parts_;
  double edges_ = 0;  // edge ends at unknowns: an edge between two unknowns counts half for each
  std::vector<Row4> moves_;
};

/// Limits the part `own` of each move of `step` that the neighbours do not share to the mean length
/// of the edges at the vertex. Returns the number of shortened moves in this part of the mesh.
std::int64_t shorten_own_moves(const Unknowns& unknowns, const Points& own,
                               const PerVertex& edge_length, Points& step);

}  // namespace ibmfair
