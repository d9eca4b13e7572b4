// The table of mesh formats. A new format is one file with a reader, and one row in formats.cpp.
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

/// What a format's reader finds.
struct ParsedMesh {
  Mesh mesh;
  bool has_texture_coordinates = false;
  bool has_normals = false;
  std::vector<std::string> notes;
  std::optional<MeshAttributes> attributes;  ///< where the reader gets them for nothing
};

/// A file to be written as its source's bytes with the vertices of `moved` replaced, and what the
/// extension has, if there is one, put behind the source's vertices and faces.
struct PatchRequest {
  const SourceBytes& source;
  const Mesh& mesh;                        ///< as read from `source`
  bool has_texture_coordinates;            ///< as read from `source`
  bool has_normals;                        ///< as read from `source`
  const Points& X;                         ///< #V x 3, the new positions
  const std::vector<std::uint8_t>& moved;  ///< #V
  bool any_moved;                          ///< without an extension always
  WriteOptions::PlyReal ply_real = WriteOptions::PlyReal::promote;
  const Extension* extension = nullptr;  ///< fits `mesh`
};

/// A file to be written from the model.
struct GenerateRequest {
  const Mesh& mesh;
  const MeshAttributes& attributes;
  const SourceBytes* source =
      nullptr;  ///< a file of the same format whose flavour to keep, or none
};

/// One format. Functions that a format does not have are null.
struct Format {
  std::string_view name;                         ///< "obj"
  std::string_view title;                        ///< "Wavefront OBJ"
  std::span<const std::string_view> extensions;  ///< lower case, without the dot
  bool always_weld = false;                      ///< the format has no shared vertices

  /// Whether a file that starts like this is of the format.
  bool (*recognises)(std::string_view bytes) = nullptr;
  ParsedMesh (*read)(const SourceBytes& source, std::string_view extension) = nullptr;
  /// Null where `read` gives the attributes, and where the format has none.
  MeshAttributes (*read_attributes)(const SourceBytes& source, const Mesh& mesh) = nullptr;
  std::vector<std::uint8_t> (*vertex_mask)(const SourceBytes& source, const Mesh& mesh,
                                           std::string_view name) = nullptr;
  /// A number for each vertex as the file counts them; nothing where none has that name.
  std::optional<std::vector<double>> (*vertex_values)(const SourceBytes& source,
                                                      std::string_view name) = nullptr;
  /// Both return notes for the user.
  std::vector<std::string> (*patch)(const PatchRequest& request, ByteSink& out) = nullptr;
  std::vector<std::string> (*generate)(const GenerateRequest& request, ByteSink& out) = nullptr;
};

/// Every format, our own first.
std::span<const Format> formats();

/// The format with this name or extension, in any case; nullptr where there is none.
const Format* find_format(std::string_view name_or_extension);

/// The part of a path's last component after its last dot, in lower case; empty where there is
/// none.
std::string path_extension(std::string_view path);

/// The names of the formats that can be written: "obj, ply, off".
std::string writable_formats();

}  // namespace ibmfair
