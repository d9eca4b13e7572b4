// Reads through assimp every format that this library does not read itself. assimp runs in a
// separate process (the program ibmfair-assimp, src/assimp_helper), so that a file that exploits a
// bug of assimp or exhausts its memory only ends that process. The process opens no files except
// those in the folder of the file that it reads.
#pragma once

#include <cstddef>
#include <string_view>

#include "ibmfair/io/formats.h"
#include "ibmfair/io/import_reply.h"

namespace ibmfair {

/// The limits for reading a file of this size: 10 s plus 4 s a megabyte, and 2 GiB plus 64 bytes a
/// byte. This is many times what assimp needs for the slowest formats.
ImportLimits import_limits(std::size_t file_size);

/// Reads the file through assimp; `extension` tells assimp the format. Throws BadFile if assimp is
/// not installed, rejects the file, crashes, or exceeds the limits (time spent waiting may be four
/// times the limit of processor time), and OutOfMemory if a memory limit of this process is the
/// reason.
ParsedMesh read_through_assimp(const SourceBytes& source, std::string_view extension,
                               const ImportLimits& limits);

/// Reads the file through assimp with the limits for its size.
ParsedMesh read_through_assimp(const SourceBytes& source, std::string_view extension);

}  // namespace ibmfair
