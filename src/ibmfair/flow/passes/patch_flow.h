// The flow of a patch: a few vertices flow while the rest of the mesh is fixed. Compared with a
// step of the whole mesh this costs next to nothing, and is independent of the rest of the mesh.
#pragma once

#include <cstdint>
#include <mutex>
#include <vector>

#include "ibmfair/base/compressed_rows.h"
#include "ibmfair/flow/passes/local_mesh.h"
#include "ibmfair/flow/steps/flow_problem.h"

namespace ibmfair {

/// Vertices that are unknowns, each once.
using VertexPatch = std::vector<Index>;

/// The connected components of the problem's unknown vertices flagged in `wanted` (#V). Fixed
/// vertices are left out, and so are neighbours of vertices that belong to another part of the
/// mesh, because this piece does not contain all of their surroundings.
std::vector<VertexPatch> patches_of(const std::vector<std::uint8_t>& wanted,
                                    const CompressedRows& rings, const FlowProblem& problem);

/// Cuts patches out of the mesh of a problem, and lets each flow by the steps of the guarded flow.
class PatchFlow {
 public:
  /// `problem` and `rings` (the result of vertex_rings) must outlive this object. The patches flow
  /// with the options of the problem, except that volume and area are not kept.
  PatchFlow(const FlowProblem& problem, const CompressedRows& rings);

  /// Lets a patch flow for `time`, starting at its positions in `X` (#V x 3). If the patch then has
  /// less energy than at the problem's state, writes its moves from that state to the result to
  /// `move` (one row per unknown, length), and returns true. Patches that share no vertex may flow
  /// at the same time.
  bool run(const VertexPatch& patch, const Points& X, double time, Points& move);

 private:
  LocalMesh cut_out(const VertexPatch& patch);

  const FlowProblem& problem_;
  const CompressedRows& rings_;
  FlowOptions options_;                // without the lists per vertex and per triangle
  std::mutex cutting_;                 // guards the scratch below
  std::vector<std::uint8_t> is_near_;  // #V, scratch
  std::vector<Index> place_;           // #V, scratch
};

}  // namespace ibmfair
