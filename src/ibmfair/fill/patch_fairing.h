// Fairs a patch to the stationary limit of the Willmore flow.
#pragma once

#include <limits>
#include <string>

#include "ibmfair/fill/patch.h"
#include "ibmfair/flow/flow_options.h"

namespace ibmfair {

struct FairingOptions {
  std::string laplacian = "lagrange";  ///< a name from bending_models()
  bool mass = true;                    ///< with the mass matrix in the energy
  std::string mass_matrix = {};        ///< one that goes with the Laplacian; empty: area_mass of it
  double tolerance = 1e-3;             ///< of the normal gradient, relative to its start
  int most_steps = 100;                ///< at one level of refinement
  int most_levels = 32;                ///< of refinement
  bool relax = false;  ///< `fair` evens the free vertices out, too, while the surface takes shape
  double memory_limit = std::numeric_limits<double>::infinity();  ///< of the whole process, bytes

  /// Throws BadOption where a value cannot be used.
  void validate() const;

  /// What they say of the energy; the rest as it is by default.
  FlowOptions flow_options() const;
};

struct FairingReport {
  bool converged = false;
  double energy_before = 0, energy_after = 0;  ///< over the stencils that touch a free vertex
  double gradient_ratio = 1;  ///< normal gradient at the end over that at the start
  double last_move = 0;       ///< along the normal in the last step, in edge lengths
  int levels = 0, steps = 0;
  FlowReport flow;  ///< unknowns of the last level; solves, factorizations and seconds of all
};

/// Takes the patch's free vertices to the stationary point of E_b on its present triangles, all
/// others held. Converged means that the normal gradient fell below the tolerance and that the last
/// step moved no vertex along its normal by more than four thousandths of the edges there. Throws
/// OutOfMemory where the patch would need more than there is, or than the limit.
FairingReport fair(Patch& patch, const FairingOptions& options);

/// Refines the patch to the edge length of the mesh around and fairs it, from coarse to fine: edges
/// of 2^k times the length first, with as many halvings as the hole's size allows. On the coarsest
/// level the patch finds its shape, and its triangles follow (relaxation and Delaunay flips); every
/// finer level starts on a curved copy of the one before and has little left to do. The patch never
/// gets more than `most_vertices` vertices of its own; `refined` tells whether that ended it.
FairingReport refine_and_fair(Patch& patch, const FairingOptions& options, Index most_vertices,
                              bool& refined);

}  // namespace ibmfair
