// Finds meshes whose vertices are on few levels, as surfaces of voxels and rounded heights are.
#pragma once

#include "ibmfair/base/types.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// The distance between successive levels (length) of a mesh that consists of steps, else 0. It
/// does if most of its normals point along axes on which the coordinates are multiples of one
/// distance that is not small compared with the edges, and if its hinges are bent not only along a
/// few creases. If the levels of the axes differ in distance, the result is their root mean square,
/// weighted by the squared components of the normals.
double level_step(const Points& X, const Topology& topology);

/// Whether the coordinates along the axis that most normals are near are multiples of one distance
/// that is shorter than the edges, but not negligible (NoiseTuning::negligible), and hinges are
/// bent as by level_step: then planes between two levels tell nothing about noise. So it is with
/// the images of depth cameras.
bool is_rounded(const Points& X, const Topology& topology);

}  // namespace ibmfair
