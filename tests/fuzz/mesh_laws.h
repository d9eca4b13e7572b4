// What holds for every mesh that a reader returns, and for every message that it refuses one with.
#pragma once

#include <string>
#include <string_view>

#include "ibmfair/base/errors.h"
#include "ibmfair/io/mesh_file.h"

namespace ibmfair::fuzz {

/// Numbers in range, coordinates finite, sizes that agree; attributes and masks included.
void require_sound(const MeshFile& file);

/// The message names the file and, where it names a place, one that the file has; it holds nothing
/// that a terminal would obey, and is no longer than one can read.
void require_clear(const BadFile& error, const std::string& name, std::string_view bytes);

/// The same faces.
bool same_faces(const Polygons& a, const Polygons& b);

}  // namespace ibmfair::fuzz
