// The reply of the importing process (src/assimp_helper): a header, followed by these arrays, whose
// sizes are in the header, in the byte order of the machine:
//
//     message         characters
//     outside         characters
//     positions       3 doubles a vertex
//     first           64-bit integers: Polygons::first, one more than there are faces
//     corner          32-bit integers: Polygons::corner
//     texture         2 doubles a vertex, if there are any
//     colours         4 doubles a vertex, if there are any
//
// If there is a message, the reply ends after `outside`.
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
  std::uint64_t message_size = 0;  ///< the reason for rejecting the file
  /// The first file that this file refers to outside its own folder; 0: there is none.
  std::uint64_t outside_size = 0;
  std::uint64_t vertices = 0;
  std::uint64_t faces = 0;
  std::uint64_t corners = 0;
  std::uint64_t left_out_faces = 0;  ///< points and lines
  std::uint64_t normals = 0;         ///< 0 or 1; the same for the next two
  std::uint64_t texture = 0;
  std::uint64_t colours = 0;
};

/// Longer messages and file names are cut off.
constexpr std::size_t longest_import_text = 1000;

/// The descriptor of the socket through which the process receives the bytes of the file and sends
/// its reply.
constexpr int import_socket = 0;

/// The arguments of the process, after its name: the path of the file (empty if it has none), the
/// extension that gives the format, the size of the file in bytes, and the limits in seconds and
/// bytes.
constexpr int import_arguments = 5;

/// The resources that the process may use before it is ended.
struct ImportLimits {
  std::chrono::seconds time;  ///< processor time
  std::int64_t memory;        ///< bytes of address space
};

/// Receives the reply of a process that was sent the file. Because a hostile file may have taken
/// over the process, the reply is checked before it is used. Throws BadFile if the process rejects
/// the file, crashes on it or sends an invalid reply, and OutOfMemory if the process needed more
/// memory than this process may have.
ParsedMesh receive_import(ImportProcess& process, const SourceBytes& source,
                          const ImportLimits& limits);

}  // namespace ibmfair
