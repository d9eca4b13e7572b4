// Meshes on which numerics break: no surface, hardly one, or one at the edge of what numbers hold.
#pragma once

#include <string>
#include <vector>

#include "support/meshes.h"

namespace ibmfair::test {

/// A mesh and what the program's exit codes for it are to be.
struct HostileMesh {
  std::string name;
  Mesh mesh;
  int smooth = 0;  ///< 1 where triangles collapse and rounding decides whether the end is reached
  int fill = 0;    ///< with all holes to be filled
};

std::vector<HostileMesh> hostile_meshes();

/// A bumpy, noisy sheet in which every `every`-th triangle is cut in three by a vertex so close to
/// one of its edges that the new triangles there have this angle.
Mesh sheet_with_needles(double degrees, Index every);

}  // namespace ibmfair::test
