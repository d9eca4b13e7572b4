// Reading and writing meshes so that what goes in comes out: same vertices, same order, same
// double-precision values, and everything else that the file holds.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/io/attributes.h"
#include "ibmfair/mesh/mesh.h"

namespace ibmfair {

struct Format;      // io/formats.h
class SourceBytes;  // io/source_bytes.h

/// How to read a file.
struct ReadOptions {
  std::string format =
      {};             ///< name or extension of a format; empty: by the path, then by the content
  bool weld = false;  ///< merge vertices at exactly the same place
};

/// A parsed mesh together with the bytes that it was parsed from. Cheap to copy.
class MeshFile {
 public:
  /// Positions and polygons in the file's order; nothing merged unless `weld` asked for it (STL,
  /// which has no shared vertices, is always welded).
  const Mesh& mesh() const;

  /// The row of the format table (io/formats.h).
  const Format& format() const;

  /// The path as given, or "standard input".
  const std::string& name() const;

  bool has_texture_coordinates() const;
  bool has_normals() const;

  /// True where vertices were merged, so that the mesh is no longer the file's own.
  bool welded() const;

  /// What a user should be told about the reading, one sentence each.
  const std::vector<std::string>& notes() const;

  /// #V, 1 for the vertices that `name` selects: those of the faces of an OBJ group, object or
  /// material, or those whose PLY vertex property is not zero. Throws BadOption that lists the
  /// names the file has, and BadFile where a PLY file has two vertex properties of this name.
  std::vector<std::uint8_t> vertex_mask(const std::string& name) const;

  /// The vertex property of this name, for each vertex the number that the file has, nan and
  /// infinities included; nothing where the file has no such property.
  /// Where vertices were welded, that of the first of them.
  std::optional<std::vector<double>> vertex_values(const std::string& name) const;

  /// Texture coordinates, colours and the like, for writing another format. Read on demand.
  MeshAttributes attributes() const;

  /// The file's own bytes.
  const SourceBytes& bytes() const;

 private:
  friend MeshFile read_mesh(std::shared_ptr<const SourceBytes> bytes, const ReadOptions& options);
  struct Contents;
  std::shared_ptr<const Contents> contents_;
};

/// Reads `path`, or standard input for "-". OBJ, PLY and OFF are read exactly; every other format
/// goes through assimp. Throws BadFile for what cannot be read or is malformed (a mesh without
/// faces included) and BadOption for an unknown format name.
MeshFile read_mesh(const std::string& path, const ReadOptions& options = {});

/// Reads a mesh from bytes that have been read already, or that come from memory.
MeshFile read_mesh(std::shared_ptr<const SourceBytes> bytes, const ReadOptions& options = {});

/// How to write a file.
struct WriteOptions {
  /// What becomes of PLY coordinates declared float once a vertex has moved: promoted to double, so
  /// that the result is kept exactly, or kept as they are, so that it is rounded.
  enum class PlyReal : std::uint8_t { promote, keep };

  std::string format = {};  ///< name or extension; empty: by the path, for "-" the source's own
  bool overwrite = false;   ///< whether an existing file may be replaced
  PlyReal ply_real = PlyReal::promote;
};

/// What was written.
struct WriteReport {
  bool patched = false;             ///< the input's own bytes, with moved coordinates replaced
  std::int64_t moved_vertices = 0;  ///< vertices whose coordinates differ from the source's
  std::int64_t bytes = 0;
  std::vector<std::string> notes;  ///< what could not be kept, one sentence each
};

/// Writes `source` with its vertices at `X` (#V x 3, as many as the source has) to `path`, or to
/// standard output for "-". Where the format is the source's own, the output is the source's bytes
/// with only the coordinates of moved vertices (and normals that depend on them) replaced;
/// otherwise the file is generated and keeps what the format can hold. Throws CannotWrite, with the
/// target as it was before; BadOption where the format cannot be written; BadMesh for a coordinate
/// that is not finite.
WriteReport write_mesh(const MeshFile& source, const Points& X, const std::string& path,
                       const WriteOptions& options = {});

/// Throws BadOption where `write_mesh` would for the format, so that a long computation need not
/// run into it at its end.
void require_writable_format(const MeshFile& source, const std::string& path,
                             const WriteOptions& options);

/// Writes a mesh that comes from no file.
WriteReport write_mesh(const Mesh& mesh, const std::string& path, const WriteOptions& options = {});

}  // namespace ibmfair
