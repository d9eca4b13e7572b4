// What a run of `smooth` does: the options, resolved on a mesh in one place.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "commands/progress.h"
#include "commands/smooth_arguments.h"
#include "ibmfair/flow/mesh_parts.h"
#include "ibmfair/flow/passes/meeting_lines.h"
#include "ibmfair/flow/passes/outliers.h"
#include "ibmfair/flow/passes/rim_fairing.h"
#include "ibmfair/flow/settings/cutoff_choice.h"
#include "ibmfair/flow/settings/thin_walls.h"
#include "ibmfair/flow/willmore_flow.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair::commands {

/// A mesh, or one process's piece of it, with the data at its vertices that the options name.
struct SmoothInput {
  const Points& X;  ///< #V x 3
  const Topology& topology;
  const MeshParts& parts = MeshParts::one();
  bool textured = false;                ///< the mesh has texture coordinates
  Eigen::VectorXd weights = {};         ///< #V, of --weights; empty without the option
  Eigen::VectorXd h0 = {};              ///< #V, of --h0; empty without the option
  std::vector<Index> listed = {};       ///< vertices of --fix
  std::vector<std::uint8_t> mask = {};  ///< #V, of --mask; empty without the option
  SolverMaker make_solver = {};         ///< makes the solver in place of --solver
};

/// Creases that are kept because this reduces the expected error.
struct FoundCreases {
  double sharp_angle = 0;  ///< radians
  CutoffChoice without;    ///< the best cut-off if no creases are kept
};

struct SmoothPlan {
  FlowOptions flow;                     ///< complete
  std::vector<std::uint8_t> fixed;      ///< #V, 1 for vertices that do not move
  bool textured = false;                ///< the mesh has texture coordinates
  double mean_edge_length = 0;          ///< before the flow
  double diagonal = 0;                  ///< of the bounding box, before the flow
  double cutoff = 0;                    ///< length that corresponds to flow.total_time
  std::optional<CutoffChoice> choice;   ///< how `cutoff` was chosen, with --cutoff auto
  std::optional<FoundCreases> creases;  ///< with --denoise
  Outliers outliers;                    ///< with --denoise; are moved before all else
  std::vector<MeetingLine> lines;       ///< where sheets meet; none if the mesh is in parts
  Eigen::VectorXd line_factor;          ///< #V, of the cut-off at vertices of `lines`
  WallSample wall_sample;               ///< empty if the mesh is in parts
  ThinWalls thin;                       ///< their rims are among the fixed vertices
  std::optional<RimFairing> rims;       ///< with --boundary fair: what comes before the flow
  bool scales_components = false;       ///< the cut-off is shorter on components of short edges
  bool restores_rims = false;           ///< rims get back what the flow takes besides noise
  double seconds_choice = 0, seconds_directions = 0, seconds_walls = 0;

  /// Whether vertices may be moved after the flow, which keeps what the flow options promise.
  bool may_restore() const {
    return !flow.keep_volume && !flow.keep_area && !std::isfinite(flow.max_move);
  }
};

/// Resolves the arguments on a mesh. Vertices are fixed by --boundary, --fix, --mask and weights of
/// 0. With --denoise and no --max-move, outliers are found first, and all else is resolved on the
/// mesh without them. With --cutoff auto, and if any vertex can move, the cut-off is chosen, and
/// whether creases are kept; both from the mesh without its rims, if it has more. With
/// --anisotropy, the direction is projected onto the surface that the same flow without anisotropy
/// produces, and carried back to the mesh with its triangles: the triangles of the noisy mesh,
/// turned and stretched by the noise, would each give a different direction. With --dry-run or
/// without steps it is projected onto the mesh as it is. Throws BadMesh if the edges are so long or
/// short that the time of the flow overflows or underflows, and like choose_cutoff, willmore_flow
/// and material_directions.
SmoothPlan plan_smoothing(const SmoothArguments& arguments, const SmoothInput& input,
                          Progress& progress);

}  // namespace ibmfair::commands
