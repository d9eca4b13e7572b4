// Meshes with holes whose best filling is known, or that must close.
#pragma once

#include <vector>

#include "support/meshes.h"

namespace ibmfair::test {

/// An icosphere of radius 1, in triangles.
Mesh sphere(int level);

/// The mesh without the faces of these numbers; vertices stay.
Mesh without_triangles(const Mesh& mesh, const std::vector<Index>& faces);

/// Without the triangles all of whose corners are within `degrees` of a skew axis, seen from the
/// origin, and without the vertices that nothing uses any more.
Mesh without_cap(const Mesh& mesh, double degrees);

/// A sphere without a cap of 40 degrees, but with the cap of 12 degrees in the middle of the hole,
/// `lift` above its place.
Mesh with_island(const Mesh& ball, double lift);

/// A sheet (`flat_sheet`) without the faces in the middle third and more: those whose centre is
/// within `cells` cells of the sheet's centre, in both directions.
Mesh with_square_hole(const Mesh& sheet, Index cells);

/// Without the faces around every hundredth vertex: many holes of five and six edges.
Mesh with_many_holes(const Mesh& mesh);

/// Closed surfaces with holes of three edges and more, apart from each other, touching in a vertex,
/// sharing a pinched vertex, and in more than one component.
std::vector<NamedMesh> holed_meshes();

}  // namespace ibmfair::test
