// What the importing process (src/assimp_helper) tells the program: a header, then as many of the
// following as it says, one after the other in the machine's own byte order:
//
//     message         characters
//     outside         characters
//     positions       3 doubles a vertex
//     first           64-bit integers: Polygons::first, one more than there are faces
//     corner          32-bit integers: Polygons::corner
//     texture         2 doubles a vertex, where it has any
//     colours         4 doubles a vertex, where it has any
//
// After a message, positions and all the rest are missing.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

#include "ibmfair/io/formats.h"

namespace ibmfair {

class ImportProcess;

enum class ImportStatus : std::uint64_t { done, refused, out_of_memory };

struct ImportHeader {
  ImportStatus status = ImportStatus::done;
  std::uint64_t message_size = 0;  ///< why it was refused
  std::uint64_t outside_size = 0;  ///< first file that it refers to outside its folder; 0: none
  std::uint64_t vertices = 0;
  std::uint64_t faces = 0;
  std::uint64_t corners = 0;
  std::uint64_t left_out_faces = 0;  ///< points and lines
  std::uint64_t normals = 0;         ///< 0 or 1, as the following
  std::uint64_t texture = 0;
  std::uint64_t colours = 0;
};

/// Longer texts are cut.
constexpr std::size_t longest_import_text = 1000;

/// The descriptor of the socket through which the process receives the file's bytes and replies.
constexpr int import_socket = 0;

/// The process's arguments, after its name: the file's path (empty: it has none), the extension
/// that tells its format, how many bytes it has, and the limits, in seconds and bytes.
constexpr int import_arguments = 5;

/// What the process may take before it is ended.
struct ImportLimits {
  std::chrono::seconds time;  ///< on a processor
  std::int64_t memory;        ///< bytes of address space
};

/// Receives the reply of a process that was sent the file. It has read a file that may be hostile,
/// so nothing that it says is believed before it is checked. Throws BadFile where the process
/// refuses the file, is ended by it, or replies what makes no sense; OutOfMemory where it needed
/// more than this process may have itself.
ParsedMesh receive_import(ImportProcess& process, const SourceBytes& source,
                          const ImportLimits& limits);

}  // namespace ibmfair
