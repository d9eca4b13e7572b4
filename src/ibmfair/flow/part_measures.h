// Sizes of a mesh in several parts (flow/mesh_parts.h), computed together by all processes, each
// from its piece; X is #V x 3. For a mesh in one piece the results equal those of mesh/geometry.h
// in every bit.
#pragma once

#include <span>

#include "ibmfair/base/types.h"
#include "ibmfair/flow/mesh_parts.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// The mean edge length, length; 0 for a mesh without edges.
double mean_edge_length(const Points& X, const Topology& topology, const MeshParts& parts);

/// The diagonal of the bounding box, length.
double diagonal(const Points& X, const MeshParts& parts);

/// The surface area, length^2.
double surface_area(const Points& X, const Topology& topology, const MeshParts& parts);

/// The share of an element (edge, triangle, stencil) with these vertices that belongs to this part:
/// the share of its vertices that do. The piece of every part that owns one of these vertices
/// contains the element, so that the shares of all parts add up to 1.
double own_share(std::span<const Index> vertices, const MeshParts& parts);

}  // namespace ibmfair
