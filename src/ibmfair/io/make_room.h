// Memory for the mesh of a large file.
#pragma once

#include <cstdint>

#include "ibmfair/mesh/mesh.h"

namespace ibmfair {

/// Sizes mesh.X for `vertices` and reserves memory for faces, in large pages. Memory that stays
/// untouched costs nothing.
void make_room(Mesh& mesh, std::int64_t vertices, std::int64_t faces, std::int64_t corners);

}  // namespace ibmfair
