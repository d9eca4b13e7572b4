// Meshes on which numerical methods break: some are not surfaces, some are nearly not surfaces, and
// some have numbers at the limit of floating-point arithmetic.
#pragma once

#include <string>
#include <vector>

#include "support/meshes.h"

namespace ibmfair::test {

/// A mesh and the exit codes that the program must return for this mesh.
struct HostileMesh {
  std::string name;
  Mesh mesh;
  int smooth = 0;  ///< 1 if triangles collapse and rounding decides between 1 and 0
  int fill = 0;    ///< when all holes are to be filled
};

std::vector<HostileMesh> hostile_meshes();

/// A bumpy, noisy sheet. Every `every`-th triangle is cut in three by a vertex so close to one of
/// the triangle's edges that the new triangle at this edge has this angle.
Mesh sheet_with_needles(double degrees, Index every);

}  // namespace ibmfair::test
