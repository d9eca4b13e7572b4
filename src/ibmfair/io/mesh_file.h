// Reads and writes meshes without loss: the same vertices in the same order, the same
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
struct Weld;        // io/weld.h
class SourceBytes;  // io/source_bytes.h

/// Options for reading a file.
struct ReadOptions {
  /// Name or extension of a format. If empty, the path determines the format, or else the content.
  std::string format = {};
  bool weld = false;  ///< merge vertices with exactly the same position
};

/// The lines of an OBJ file that start with none of the format's keywords, and are not read.
struct UnknownStatements {
  std::int64_t count = 0;
  std::int64_t line = 0;     ///< the first of these lines, counted from 1
  std::string keyword = {};  ///< the first word of that line, shortened
};

/// A parsed mesh together with the bytes it was parsed from. Cheap to copy.
class MeshFile {
 public:
  /// Positions and polygons in the file's order. Vertices are merged only if `weld` was set, or in
  /// STL, which has no shared vertices and is always welded.
  const Mesh& mesh() const;

  /// The format of the file, a row of the format table (io/formats.h).
  const Format& format() const;

  /// The path as given, or "standard input".
  const std::string& name() const;

  bool has_texture_coordinates() const;
  bool has_normals() const;

  /// Whether vertices were merged, so that the mesh is no longer that of the file.
  bool welded() const;

  /// The number in mesh() of each vertex of the file; empty unless welded().
  const std::vector<Index>& merged_vertices() const;

  /// Notes on the reading for the user, one sentence each.
  const std::vector<std::string>& notes() const;

  /// Signs of damage in the file, one sentence each, that begin with the file and the place.
  const std::vector<std::string>& warnings() const;
  const UnknownStatements& unknown_statements() const;

  /// #V, 1 for each vertex that `name` selects: the vertices of the faces in an OBJ group, object
  /// or material of this name, or those whose PLY vertex property of this name is not zero. Throws
  /// BadOption with a list of the names in the file if `name` is not one of them, and BadFile if a
  /// PLY file has two vertex properties of this name.
  std::vector<std::uint8_t> vertex_mask(const std::string& name) const;

  /// The value of the vertex property of this name for each vertex, including NaN and infinities;
  /// nothing if the file has no such property. A welded vertex has the value of the first of the
  /// vertices that were merged.
  std::optional<std::vector<double>> vertex_values(const std::string& name) const;

  /// Texture coordinates, colours and similar data, for writing another format. Not stored with the
  /// mesh: most formats read them from the bytes in every call.
  MeshAttributes attributes() const;

  /// The bytes of the file.
  const SourceBytes& bytes() const;

  /// A copy with other positions (#V x 3), which need not be those in the bytes.
  MeshFile with_positions(Points X) const;

  /// A copy that also has the vertex property `name` (#V of the file). It comes before one of this
  /// name in the bytes.
  MeshFile with_values(std::string name, std::vector<double> values) const;

  /// A copy in which vertices at exactly the same position are merged, as by ReadOptions::weld.
  MeshFile merged_exactly() const;

 private:
  friend MeshFile read_mesh(std::shared_ptr<const SourceBytes> bytes, const ReadOptions& options);
  friend struct CloseWeld;
  struct Contents;
  std::shared_ptr<const Contents> contents_;
};

/// Reads a mesh from `path`, or from standard input for "-". OBJ, PLY, OFF and 3MF are read
/// exactly; every other format is read through assimp. Throws BadFile for a file that cannot be
/// read, is malformed or has no faces, and BadOption for an unknown format name.
MeshFile read_mesh(const std::string& path, const ReadOptions& options = {});

/// Reads a mesh from bytes that are in memory already.
MeshFile read_mesh(std::shared_ptr<const SourceBytes> bytes, const ReadOptions& options = {});

/// A mesh whose vertices were merged where they are close to each other.
struct CloseWeld {
  MeshFile file;
  std::int64_t merged = 0;           ///< vertices that became one with another vertex
  double farthest = 0;               ///< of them from its new place, length
  std::int64_t collapsed_edges = 0;  ///< edges whose two ends became one vertex
  std::int64_t collapsed_faces = 0;  ///< faces that were left out because they had collapsed

  /// Merges the vertices of `source` that find_close_vertices (io/weld.h) finds. Corners that
  /// repeat the corner before them, and faces that then have fewer than three corners, are left
  /// out.
  CloseWeld(const MeshFile& source, double tolerance);

  /// Merges the vertices of `source` in this way.
  CloseWeld(const MeshFile& source, const Weld& weld);
};

/// Options for writing a file.
struct WriteOptions {
  /// How PLY files declare the coordinates. `keep`: a file in which they are float keeps this type
  /// if float32_suffices (io/precision.h); all other files declare them double once a vertex has
  /// moved. `float32` and `float64`: always float, or always double.
  enum class Precision : std::uint8_t { keep, float32, float64 };

  std::string format = {};  ///< name or extension; empty: by the path, or the source's for "-"
  bool overwrite = false;   ///< whether to replace an existing file
  Precision precision = Precision::keep;
};

/// A report on the file that was written.
struct WriteReport {
  bool patched = false;  ///< the source's bytes were kept, with moved coordinates replaced
  std::int64_t moved_vertices = 0;  ///< vertices whose coordinates differ from the source's
  std::int64_t bytes = 0;
  std::vector<std::string> notes;  ///< what could not be kept, one sentence each
};

/// Writes `source` with its vertices at `X` (#V x 3, with the vertex count of the source) to
/// `path`, or to standard output for "-". If the format is that of the source, the output is the
/// source's bytes with only the coordinates of moved vertices (and normals that depend on them)
/// replaced. Otherwise the file is generated and keeps the data that the format can hold. Throws
/// CannotWrite, leaving the target as it was; BadOption if the format cannot be written; BadMesh
/// for a coordinate that is not finite.
WriteReport write_mesh(const MeshFile& source, const Points& X, const std::string& path,
                       const WriteOptions& options = {});

/// Throws BadOption if `write_mesh` would do so because of the format, so that a long computation
/// does not fail only at its end.
void require_writable_format(const MeshFile& source, const std::string& path,
                             const WriteOptions& options);

/// Writes a mesh that was not read from a file.
WriteReport write_mesh(const Mesh& mesh, const std::string& path, const WriteOptions& options = {});

}  // namespace ibmfair
