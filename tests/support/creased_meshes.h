// Meshes with sharp edges, and holes in any place.
#pragma once

#include <array>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/mesh/mesh.h"

namespace ibmfair::test {

/// The cube [-1, 1]^3 of 12 * 4^level triangles.
Mesh cube(int level);

/// The closed surface of revolution about the z axis that this profile makes: points (r, z), of
/// which the first and the last lie on the axis. Each of the others becomes a ring of `around`
/// vertices. The surface is oriented outward if the profile goes upward.
Mesh turned(const std::vector<std::array<double, 2>>& profile, Index around);

/// A closed cylinder of radius 1 from z = 0 to z = 1, with flat ends.
Mesh closed_cylinder(Index around);

/// A closed cone of base radius 1 and height 1 with its tip at (0, 0, 1).
Mesh closed_cone(Index around);

/// The mesh without the triangles within so many rings of the vertex nearest to `place`. All
/// vertices stay.
Mesh without_rings(const Mesh& mesh, const Vec3& place, int rings);

}  // namespace ibmfair::test
