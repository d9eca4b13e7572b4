// The thickness of the walls of a solid: how far the opposite sheet of its surface is.
#pragma once

#include <limits>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// The wall behind a triangle.
struct Wall {
  double thickness = std::numeric_limits<double>::infinity();  ///< length; infinite if none
  Index opposite = -1;          ///< the triangle on the other side, or -1
  Vec3 weights = Vec3::Zero();  ///< barycentric coordinates in `opposite` of the point over there

  bool exists() const { return opposite >= 0; }
};

/// The wall behind each of the given triangles (rows of Topology::F): the distance from the
/// triangle's centroid, along the inward normal, to the next triangle of the same component that
/// faces the other way, if that is at most `thickest` (length) away. Normals are averaged over the
/// triangles around the corners, so that noise and foldovers matter little. Inward is the side on
/// which the component encloses its volume. Components that are not closed or not orientable have
/// no walls. Goes through all triangles once.
std::vector<Wall> find_walls(const Points& X, const Topology& topology,
                             const std::vector<Index>& triangles, double thickest);

/// The sum of the double area vectors of the triangles at each vertex, #V x 3, length^2. The
/// averaged normal of a triangle is the direction of the sum over its corners.
Points vertex_area_vectors(const Points& X, const Topology& topology);

/// The thickness of a wall of triangle t in the positions Y of the same mesh, from the triangle's
/// centroid to the point that was opposite when the wall was found, along the triangle's averaged
/// normal; negative where the two sheets have passed through each other. `outward` is 1 or -1, as
/// the triangles of the component face outwards or inwards (outward_signs); `area_vectors` is
/// vertex_area_vectors(Y, topology).
double thickness_at(const Points& Y, const Points& area_vectors, const Topology& topology, Index t,
                    const Wall& wall, int outward);

/// 1 or -1 for each component whose triangles face outwards or inwards; 0 for components that are
/// not closed or not orientable.
std::vector<int> outward_signs(const Points& X, const Topology& topology);

}  // namespace ibmfair
