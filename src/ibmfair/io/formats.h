// The table of mesh formats. To add a format, write one file with a reader and add one row in
// formats.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ibmfair/io/attributes.h"
#include "ibmfair/io/mesh_file.h"
#include "ibmfair/mesh/mesh.h"

namespace ibmfair {

class ByteSink;
struct Extension;  // io/extension.h
struct FaceEdit;   // io/face_edits.h

/// The result of a format's reader.
struct ParsedMesh {
  Mesh mesh;
  bool has_texture_coordinates = false;
  bool has_normals = false;
  std::vector<std::string> notes;
  std::vector<std::string> warnings = {};  ///< see MeshFile
  UnknownStatements unknown = {};          ///< see MeshFile
  /// Set if reading the mesh gives the attributes at no extra cost.
  std::optional<MeshAttributes> attributes;
};

/// The types with which a PLY file declares the coordinates.
enum class CoordinateTypes : std::uint8_t {
  by_rounding,  ///< as_declared, but float64 unless float32_suffices (io/precision.h)
  as_declared,  ///< those of the source; float64 for moved integers, and without a source
  float32,
  float64
};

/// A request to write the bytes of the source with the vertices in `moved` replaced, and with the
/// vertices and faces of the extension, if there is one, added after those of the source.
struct PatchRequest {
  const SourceBytes& source;
  const Mesh& mesh;                        ///< as read from `source`
  bool has_texture_coordinates;            ///< as read from `source`
  bool has_normals;                        ///< as read from `source`
  const Points& X;                         ///< #V x 3, the new positions
  const std::vector<std::uint8_t>& moved;  ///< #V
  bool any_moved;  ///< whether any vertex moved; always true without an extension
  /// float32 and float64 apply even if nothing moves; the others only if a vertex moves or is
  /// added.
  CoordinateTypes types = CoordinateTypes::by_rounding;
  const Extension* extension = nullptr;  ///< fits `mesh`
  std::string why_float64 = {};          ///< the reason for float64, a part of a note
};

/// A request to write the bytes of the source with some of its faces replaced.
struct EditRequest {
  const SourceBytes& source;
  const Mesh& mesh;                    ///< as read from `source`
  const std::vector<FaceEdit>& edits;  ///< at least one
};

/// A request to generate a file from the mesh and its attributes.
struct GenerateRequest {
  const Mesh& mesh;
  const MeshAttributes& attributes;
  /// A file of the same format whose variant of the format is kept; null if there is none.
  const SourceBytes* source = nullptr;
  CoordinateTypes types = CoordinateTypes::as_declared;
};

/// One format. A function that the format does not support is null.
struct Format {
  std::string_view name;                     ///< "obj"
  std::string_view title;                    ///< "Wavefront OBJ"
  std::vector<std::string_view> extensions;  ///< lower case, without the dot
  bool always_weld = false;     ///< vertices are always merged because the format cannot share them
  bool declares_types = false;  ///< files declare the types of their coordinates

  /// Whether a file that starts with these bytes is in this format.
  bool (*recognises)(std::string_view bytes) = nullptr;
  ParsedMesh (*read)(const SourceBytes& source, std::string_view extension) = nullptr;
  /// Null if `read` returns the attributes, or if the format has none.
  MeshAttributes (*read_attributes)(const SourceBytes& source, const Mesh& mesh) = nullptr;
  std::vector<std::uint8_t> (*vertex_mask)(const SourceBytes& source, const Mesh& mesh,
                                           std::string_view name) = nullptr;
  /// The value of the vertex property `name` for each vertex, numbered as in the file; nothing if
  /// the file has no property of this name.
  std::optional<std::vector<double>> (*vertex_values)(const SourceBytes& source,
                                                      std::string_view name) = nullptr;
  /// Returns false, whatever was written, if the faces cannot be replaced in these bytes.
  bool (*edit_faces)(const EditRequest& request, ByteSink& out) = nullptr;
  /// Both functions return notes for the user.
  std::vector<std::string> (*patch)(const PatchRequest& request, ByteSink& out) = nullptr;
  std::vector<std::string> (*generate)(const GenerateRequest& request, ByteSink& out) = nullptr;
};

/// All formats; those that this library reads itself come first.
std::span<const Format> formats();

/// The format with this name or extension, in upper or lower case; nullptr if there is none.
const Format* find_format(std::string_view name_or_extension);

/// Whether a file with this name holds gzip data, as `mesh.ply.gz` does.
bool is_gzip_name(std::string_view path);

/// The part of a path's last component after its last dot, in lower case and without a final `.gz`;
/// empty if there is no dot.
std::string path_extension(std::string_view path);

/// The names of the formats that can be written: "ply, off, obj, stl".
std::string writable_formats();

/// The names of the formats that can be read, without the last row, which stands for many others.
std::string readable_formats();

}  // namespace ibmfair
