// Fairs open boundaries along themselves. The bending energy of a surface hardly sees ripples along
// its rim: they cost nothing where only complete rings of triangles carry energy. So each rim is
// smoothed as a curve first, by the flow of its own bending energy 1/2 sum |x_i-1 - 2 x_i +
// x_i+1|^2 over its vertices, in steps of backward Euler with one constant factor (as the flow of
// the surface: [W07] section 3.2), and with twicing (flow/passes/twicing.h). Corners stay.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "ibmfair/mesh/topology.h"

namespace ibmfair {

struct RimFairing {
  /// The wavelength along the rim, length; positive. With noise, longer ones are tried as well.
  double cutoff = 0;
  int twicing = 1;
  /// The standard deviation of the noise along the normals, length; 0 for a rim that is to be
  /// smooth, whatever it is like. With noise, moves along the surface's normals are made in full.
  /// Of those within the surface (along and across the rim) only the share that noise explains is
  /// made, for each run of a rim and either direction (W. James, C. Stein, "Estimation with
  /// quadratic loss", 1961): a zigzag of the triangles that is larger than the noise stays for the
  /// most part, and a smooth outline has nothing that would be removed.
  double noise = 0;
  double max_move = std::numeric_limits<double>::infinity();  ///< length
};

/// Fairs the runs (flow/passes/rim_runs.h) of all rims with moving vertices. No hinge folds over:
/// where one would, moves are shortened. `X`: #V x 3; `fixed`: #V flags of vertices that do not
/// move. Returns `fixed` with the vertices of the faired curves added, except for shortened moves:
/// a flow of the surface that holds them meets the curves at any angle, while a flow that moved
/// them would bend the surface outward or inward at its rims, where no curvature is the cheapest.
std::vector<std::uint8_t> fair_rims(Points& X, const Topology& topology,
                                    const std::vector<std::uint8_t>& fixed,
                                    const RimFairing& options);

}  // namespace ibmfair
