// Fairs a patch to the stationary limit of the Willmore flow.
#pragma once

#include <limits>
#include <optional>
#include <string>

#include "ibmfair/fill/patch.h"
#include "ibmfair/fill/patch_bound.h"
#include "ibmfair/flow/flow_options.h"

namespace ibmfair {

struct FairingOptions {
  std::string laplacian = "lagrange";  ///< a name from bending_models()
  bool mass = true;                    ///< with the mass matrix in the energy
  std::string mass_matrix = {};        ///< one of the Laplacian's; empty: its area_mass
  double tolerance = 1e-3;             ///< of the normal gradient, relative to its start
  int most_steps = 100;                ///< the most steps at one level of refinement
  int most_levels = 32;                ///< the most levels of refinement
  bool relax = false;  ///< `fair` also relaxes the free vertices while the surface takes shape
  double memory_limit = std::numeric_limits<double>::infinity();  ///< of the whole process, bytes

  /// Throws BadOption if a value cannot be used.
  void validate() const;

  /// Flow options with the energy of these options, and defaults for everything else.
  FlowOptions flow_options() const;
};

struct FairingReport {
  bool converged = false;
  double energy_before = 0, energy_after = 0;  ///< over the stencils that touch a free vertex
  double gradient_ratio = 1;  ///< normal gradient at the end over the normal gradient at the start
  double last_move = 0;       ///< largest move along a normal in the last step, in edge lengths
  bool ran_away = false;      ///< the fairing was ended because the patch exceeded its bound
  int levels = 0, steps = 0;
  FlowReport flow;  ///< unknowns of the last level; solves, factorizations, seconds of all levels
};

/// Where a patch starts and what it must not exceed.
struct PatchLimits {
  Index most_vertices = 0;  ///< of the patch's own
  PatchBound bound;
  std::optional<RimSphere> start = {};
  bool tube = false;  ///< the patch starts from the result of linear fairing
};

/// Moves the patch's free vertices to the stationary point of E_b on its present triangles; all
/// other vertices are fixed. `converged` means that the normal gradient fell below the tolerance
/// and that the last step moved no vertex along its normal by more than 0.004 edge lengths, or that
/// the patch is flat up to rounding errors. Throws OutOfMemory if the available memory or the
/// memory limit is too small.
FairingReport fair(Patch& patch, const FairingOptions& options);

/// Refines the patch to the edge length of the surrounding mesh and fairs it, level by level from
/// coarse to fine. The edges of the coarsest level are 2^k times as long as the final edges, with k
/// as large as the size of the hole allows. On the coarsest level the patch takes its shape, and
/// its triangulation is adapted (relaxation and Delaunay flips); every finer level refines the
/// previous one along its curvature and changes little. With `limits.start` the patch starts on
/// this sphere instead of across the rim; a tube, which may have to bend, starts from linear
/// fairing. The patch never gets more vertices of its own than the
/// limit; `refined` becomes false if the limit ended the refinement.
FairingReport refine_and_fair(Patch& patch, const FairingOptions& options,
                              const PatchLimits& limits, bool& refined);

}  // namespace ibmfair
