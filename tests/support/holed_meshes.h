// Meshes with holes whose best filling is known or whose filling must close the surface.
#pragma once

#include <vector>

#include "support/meshes.h"

namespace ibmfair::test {

/// An icosphere of radius 1, made of triangles.
Mesh sphere(int level);

/// The mesh without the faces of these numbers; all vertices stay.
Mesh without_triangles(const Mesh& mesh, const std::vector<Index>& faces);

/// The mesh without the triangles all of whose corners lie within `degrees` of a skew axis, as seen
/// from the origin, and without the vertices that no triangle uses any more.
Mesh without_cap(const Mesh& mesh, double degrees);

/// A sphere without a cap of 40 degrees, but with the cap of 12 degrees in the middle of the hole,
/// raised by `lift`.
Mesh with_island(const Mesh& ball, double lift);

/// A sheet (`flat_sheet`) without the faces whose centre is within `cells` cells of the sheet's
/// centre in both directions. The hole spans the middle third of the sheet or more.
Mesh with_square_hole(const Mesh& sheet, Index cells);

/// The mesh without the faces around every hundredth vertex: it has many holes of five and six
/// edges.
Mesh with_many_holes(const Mesh& mesh);

/// Closed surfaces with holes of three edges and more. Some holes are apart from each other, some
/// touch in a vertex, some share a pinched vertex, and some are in different components.
std::vector<NamedMesh> holed_meshes();

}  // namespace ibmfair::test
