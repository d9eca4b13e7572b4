// Sizes and angles of a triangle mesh: the same bytes for any number of threads.
#pragma once

#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Twice the area-weighted normal of triangle (a,b,c): its length is twice the area.
inline Vec3 double_area_vector(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b - a).cross(c - a);
}

/// That of triangle t.
inline Vec3 double_area_vector(const Points& X, const Triangles& F, Eigen::Index t) {
  return double_area_vector(X.row(F(t, 0)), X.row(F(t, 1)), X.row(F(t, 2)));
}

/// The sum of the double area vectors around a vertex: along its normal, zero where it has none.
Vec3 double_area_vector_at(Index v, const Points& X, const Topology& topology);

/// Triangle areas, #F, length^2.
Eigen::VectorXd triangle_areas(const Points& X, const Triangles& F);

/// Unit normals, #F x 3; zero for a triangle without area.
Points triangle_normals(const Points& X, const Triangles& F);

/// Triangles whose smallest height is not above 1e-12 of their longest edge, and those whose
/// corners are so far from the origin that no digit of the height is left.
std::vector<Index> degenerate_triangles(const Points& X, const Triangles& F);

/// Sum of the triangle areas, length^2.
double surface_area(const Points& X, const Triangles& F);

/// Signed volume enclosed by a closed mesh with coherent orientation, length^3. For an open mesh
/// the volume of the cone over it from the centroid of its vertices.
double enclosed_volume(const Points& X, const Triangles& F);

/// Mean length over the edges, each counted once; 0 for a mesh without edges.
double mean_edge_length(const Points& X, const Edges& E);

/// Lumped mass, #V: a third of the area of the usable triangles around each vertex, length^2.
PerVertex lumped_vertex_mass(const Points& X, const Topology& topology);

/// The mean length of the edges at each vertex, #V; 0 for an isolated vertex. `rings` are those of
/// vertex_rings (mesh/topology.h).
PerVertex local_edge_length(const Points& X, const Rows& rings);

/// Largest minus smallest coordinate, per axis.
Vec3 bounding_box_size(const Points& X);

/// Smallest corner angle of each triangle, #F, radians; 0 for a triangle without area.
Eigen::VectorXd smallest_angles(const Points& X, const Triangles& F);

/// The smallest of these; 0 where there is no triangle. Takes half the time.
double smallest_angle(const Points& X, const Triangles& F);

/// The triangles with a smaller angle than this (radians, below a right angle), or without area.
std::vector<Index> needles(const Points& X, const Triangles& F, double angle);

/// The dihedral angle of each hinge, #H, radians in [0, pi]: pi where flat, 0 where folded over.
Eigen::VectorXd dihedral_angles(const Points& X, const Hinges& H);

}  // namespace ibmfair
