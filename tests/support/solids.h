// Solids made of cells of a grid: plates, trays, profiles.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "ibmfair/mesh/mesh.h"

namespace ibmfair::test {

/// The triangles between the cells of a grid that are inside and those that are not, outward. The
/// cells lie between consecutive coordinates on each axis.
Mesh solid_of_cells(const std::vector<double>& x, const std::vector<double>& y,
                    const std::vector<double>& z,
                    const std::function<bool(Index, Index, Index)>& is_inside);

/// A plate of columns x rows cells of size 1 and one layer of this thickness.
Mesh plate(Index columns, Index rows, double thickness);

/// A square tray of columns x columns x height cells of size 1 inside, and walls of this thickness.
Mesh tray(Index columns, Index height, double thickness);

/// Two plates of columns x rows cells of size 1 that meet at a right angle.
Mesh angle_profile(Index columns, Index rows, double thickness);

/// A flat ring between the radii `inner` and `outer`, with edges of about 1.
Mesh washer(Index inner, Index outer, double thickness);

/// Half a sphere's shell of this outer radius and thickness, with edges of about 1.
Mesh half_shell(Index radius, double thickness);

/// A bent leaf: two sheets of columns x rows cells that share their rim and are `thickness` apart
/// within it.
Mesh leaf(Index columns, Index rows, double thickness);

/// Two half balls of voxels and the sheet between them, as the interfaces of a label map: voxels of
/// size 1 with centres within `radius` of the origin, on the two sides of a tilted plane.
Mesh two_half_balls(Index radius);

}  // namespace ibmfair::test
