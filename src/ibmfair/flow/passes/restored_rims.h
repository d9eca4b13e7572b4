// The surface near rims gets back what a flow has taken from it besides noise.
//
// At an open boundary no bending moment acts, so that no curvature is the cheapest (compare O.
// Stein, E. Grinspun, M. Wardetzky, A. Jacobson, "Natural boundary conditions for smoothing in
// geometry processing", ACM Transactions on Graphics 37, 2018). The flow straightens the last rings
// of a curved surface there: at a cut-off of 10 edges, the rim of a sphere with a radius of 25
// edges leaves the sphere by 0.18 edges. This hardly changes along the rim, while noise changes
// from vertex to vertex.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Moves the rims of X and the rings of vertices beside them back toward `start` (both #V x 3)
/// along the normals, each ring by the lasting part of its residual. The last ring is the first one
/// beside a rim where nothing lasts, or as many rings away as the cut-off has edges. The lasting
/// part is the residual after smoothing along the rim (a periodic spline by penalized least
/// squares, E. T. Whittaker, "On a new method of graduation", 1922), up to the wavelength at which
/// the expected squared error is least (C. M. Stein, "Estimation of the mean of a multivariate
/// normal distribution", 1981), and reduced by the share that noise explains. If no wavelength
/// clearly gains (RimTuning::clear_gain), the ring stays.
///
/// `cutoff`: the wavelength of the flow, length. `noise`: the standard deviation along the normals,
/// length, positive; it must be independent from vertex to vertex. Fixed vertices (#V flags) stay,
/// and no hinge folds over. Boundaries that are too short for a curve (least_rim_size) or end at
/// edges of more than two triangles are left alone.
void restore_rims(const Points& start, const Topology& topology,
                  const std::vector<std::uint8_t>& fixed, double cutoff, double noise, Points& X);

}  // namespace ibmfair
