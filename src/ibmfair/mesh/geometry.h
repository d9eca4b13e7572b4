// Lengths, areas, volumes and angles of a triangle mesh. The results are bitwise the same for any
// number of threads.
#pragma once

#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// The normal of triangle (a,b,c) with a length of twice the area.
inline Vec3 double_area_vector(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b - a).cross(c - a);
}

/// The double area vector of triangle t.
inline Vec3 double_area_vector(const Points& X, const Triangles& F, Eigen::Index t) {
  return double_area_vector(X.row(F(t, 0)), X.row(F(t, 1)), X.row(F(t, 2)));
}

/// The sum of the double area vectors of the triangles at a vertex. The direction is that of the
/// vertex normal; the sum is zero if no triangle at the vertex has area.
Vec3 double_area_vector_at(Index v, const Points& X, const Topology& topology);

/// The area of each triangle, #F, length^2.
Eigen::VectorXd triangle_areas(const Points& X, const Triangles& F);

/// Unit normals of the triangles, #F x 3; zero for a triangle without area.
Points triangle_normals(const Points& X, const Triangles& F);

/// The triangles whose smallest height is at most 1e-12 of their longest edge, or is not larger
/// than the rounding error of their coordinates (for a triangle far from the origin).
std::vector<Index> degenerate_triangles(const Points& X, const Triangles& F);

/// Sum of the triangle areas, length^2.
double surface_area(const Points& X, const Triangles& F);

/// Signed volume enclosed by a closed mesh with coherent orientation, length^3. For an open mesh,
/// the signed volume of the cone over the mesh with its apex at the centroid of the vertices.
double enclosed_volume(const Points& X, const Triangles& F);

/// Mean edge length, with each edge counted once; 0 for a mesh without edges.
double mean_edge_length(const Points& X, const Edges& E);

/// Lumped mass, #V, length^2: a third of the area of the usable triangles at each vertex.
PerVertex lumped_vertex_mass(const Points& X, const Topology& topology);

/// The mean length of the edges at each vertex, #V; 0 for an isolated vertex. `rings` is the result
/// of vertex_rings (mesh/topology.h).
PerVertex local_edge_length(const Points& X, const CompressedRows& rings);

/// Largest minus smallest coordinate, per axis.
Vec3 bounding_box_size(const Points& X);

/// Smallest corner angle of each triangle, #F, radians; 0 for a triangle without area.
Eigen::VectorXd smallest_angles(const Points& X, const Triangles& F);

/// The smallest angle of all triangles, radians; 0 if there is no triangle. Takes half the time of
/// `smallest_angles`.
double smallest_angle(const Points& X, const Triangles& F);

/// The triangles that have an angle below `angle` (radians, less than a right angle) or no area.
std::vector<Index> needles(const Points& X, const Triangles& F, double angle);

/// The dihedral angle of each hinge, #H, radians in [0, pi]: pi for a flat hinge, 0 for one folded
/// back onto itself.
Eigen::VectorXd dihedral_angles(const Points& X, const Hinges& H);

}  // namespace ibmfair
