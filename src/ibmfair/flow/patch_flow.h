// A few vertices flow by themselves, and the rest of the mesh is held: next to nothing, beside a
// step of the whole mesh, and free of all that goes on elsewhere.
#pragma once

#include <cstdint>
#include <mutex>
#include <vector>

#include "ibmfair/base/rows.h"
#include "ibmfair/flow/flow_problem.h"
#include "ibmfair/flow/local_mesh.h"

namespace ibmfair {

/// Unknown vertices, each once.
using VertexPatch = std::vector<Index>;

/// Those with a flag in `wanted` (#V), in pieces that hang together. A vertex is left out that is
/// held, or that touches one that belongs to another part of the mesh: not all around it is here.
std::vector<VertexPatch> patches_of(const std::vector<std::uint8_t>& wanted, const Rows& rings,
                                    const Unknowns& unknowns, const MeshParts& parts);

class PatchFlow {
 public:
  /// Refers to the problem and to `rings`, those of vertex_rings. The patches flow as its options
  /// say, volume and area left free.
  PatchFlow(const FlowProblem& problem, const Rows& rings);

  /// Lets a patch flow for `time` from where it is at `X` (#V x 3). Where it then has less energy
  /// than at the problem's state, writes its rows of the move that leads there from that state to
  /// `move` (one row per unknown, length), and returns true. Patches that share no vertex may flow
  /// at the same time.
  bool run(const VertexPatch& patch, const Points& X, double time, Points& move);

 private:
  LocalMesh cut_out(const VertexPatch& patch);

  const FlowProblem& problem_;
  const Rows& rings_;
  FlowOptions options_;                // without what there is one of for each vertex or triangle
  std::mutex cutting_;                 // what follows
  std::vector<std::uint8_t> is_near_;  // #V, scratch
  std::vector<Index> place_;           // #V, scratch
};

}  // namespace ibmfair
