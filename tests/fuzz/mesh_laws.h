// Laws for every mesh that a reader returns, and for every message with which it refuses a file.
#pragma once

#include <string>
#include <string_view>

#include "ibmfair/base/errors.h"
#include "ibmfair/io/mesh_file.h"

namespace ibmfair::fuzz {

/// Numbers in range, coordinates finite, sizes that agree; attributes and masks included.
void require_sound(const MeshFile& file);

/// The message names the file. If the message names a place, the file has this place. The message
/// contains no control characters that a terminal would obey, and it is short enough to be read.
void require_clear(const BadFile& error, const std::string& name, std::string_view bytes);

/// Whether the two lists have the same faces.
bool same_faces(const Polygons& a, const Polygons& b);

}  // namespace ibmfair::fuzz
