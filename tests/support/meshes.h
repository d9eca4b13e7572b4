// The classes of meshes over which tests sweep their laws. All meshes are small (below 3000 faces)
// and are made here, not by the code under test.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "ibmfair/mesh/mesh.h"

namespace ibmfair::test {

struct NamedMesh {
  std::string name;
  Mesh mesh;
};

/// Closed meshes, oriented outward, without defects: tetrahedron, octahedron, a cube of
/// quadrilaterals, a bumpy sphere, a torus, and two spheres of different sizes apart from each
/// other.
std::vector<NamedMesh> closed_meshes();

/// Meshes with a boundary, without defects: one triangle, a square of quadrilaterals, a bumpy
/// sheet, an annulus (two loops), an open cylinder, and a sheet beside a sphere.
std::vector<NamedMesh> open_meshes();

/// The closed and the open meshes together.
std::vector<NamedMesh> good_meshes();

/// Surfaces without a coherent orientation: a Moebius strip and a Klein bottle.
std::vector<NamedMesh> nonorientable_meshes();

/// Meshes with one kind of defect each in an otherwise good surface. The name of a mesh is its
/// defect: `bow tie`, `non-manifold edge`, `zero area`, `repeated corner`, `duplicate face`,
/// `isolated vertex`.
std::vector<NamedMesh> defective_meshes();

/// All of the above.
std::vector<NamedMesh> all_meshes();

/// A mesh is left as it is, scaled by 1e-8, scaled by 1e8, or moved from the origin by 1e5 times
/// its size.
enum class Placement { as_is, tiny, huge, far_away };
inline constexpr std::array all_placements{Placement::as_is, Placement::tiny, Placement::huge,
                                           Placement::far_away};

/// Every mesh in this placement; the names of the meshes say which.
std::vector<NamedMesh> placed(const std::vector<NamedMesh>& meshes, Placement placement);

/// Every mesh in all placements.
std::vector<NamedMesh> at_all_scales(const std::vector<NamedMesh>& meshes);

/// A flat sheet of columns x rows quadrilaterals over the unit square, each cut in two triangles.
Mesh flat_sheet(Index columns, Index rows);

/// Two poles with `around` triangles each, and between them two rings of `around` vertices each.
Mesh barrel(Index around);

/// The mesh with the orientation of its faces flipped at random (fixed by `seed`). Results that do
/// not depend on orientation must not change.
Mesh with_mixed_orientation(const Mesh& mesh, unsigned seed = 1);

/// X -> scale * R * X + offset with a fixed rotation R about a skew axis.
Mesh moved(const Mesh& mesh, double scale, const Vec3& offset, double angle = 0.7);

}  // namespace ibmfair::test
