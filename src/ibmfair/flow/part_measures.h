// Sizes of a mesh in several parts (flow/mesh_parts.h), each from its piece: X is #V x 3. Of a mesh
// in one piece they are those of mesh/geometry.h to the bit.
#pragma once

#include <span>

#include "ibmfair/base/types.h"
#include "ibmfair/flow/mesh_parts.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Length; 0 for a mesh without edges.
double mean_edge_length(const Points& X, const Topology& topology, const MeshParts& parts);

/// Of the bounding box, length.
double diagonal(const Points& X, const MeshParts& parts);

/// Length^2.
double surface_area(const Points& X, const Topology& topology, const MeshParts& parts);

/// How much of an element with these vertices belongs to the part: the share of those that do.
/// Every part that has one of them has the element, so that the shares add up to 1.
double own_share(std::span<const Index> vertices, const MeshParts& parts);

}  // namespace ibmfair
