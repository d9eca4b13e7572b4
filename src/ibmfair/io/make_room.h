// Reserves memory for the mesh of a large file.
#pragma once

#include <cstdint>

#include "ibmfair/mesh/mesh.h"

namespace ibmfair {

/// Resizes mesh.X to `vertices` rows and reserves memory for the faces, in large pages. Reserved
/// memory costs nothing until it is used.
void make_room(Mesh& mesh, std::int64_t vertices, std::int64_t faces, std::int64_t corners);

}  // namespace ibmfair
