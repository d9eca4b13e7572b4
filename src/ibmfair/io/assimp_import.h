// Every format that is not our own, read through assimp. It runs in a process of its own (the
// program ibmfair-assimp, src/assimp_helper), which a file that exploits or exhausts it ends
// without harm, and which opens nothing but files in the folder of the one that it reads.
#pragma once

#include <cstddef>
#include <string_view>

#include "ibmfair/io/formats.h"
#include "ibmfair/io/import_reply.h"

namespace ibmfair {

/// Many times what assimp takes for the slowest formats: 10 s and 4 s a megabyte, 2 GiB and 64
/// bytes a byte.
ImportLimits import_limits(std::size_t file_size);

/// Reads the file through assimp; `extension` tells it the format. Throws BadFile where assimp is
/// missing, refuses the file, crashes on it or exceeds the limits (of time, by four times as much
/// where it only waits); OutOfMemory where a limit of this process itself is in the way.
ParsedMesh read_through_assimp(const SourceBytes& source, std::string_view extension,
                               const ImportLimits& limits);

/// Reads within the limits for a file of this size.
ParsedMesh read_through_assimp(const SourceBytes& source, std::string_view extension);

}  // namespace ibmfair
