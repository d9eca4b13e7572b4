// Binary PLY files of triangles, by their rows: where they stand in the file, and how rows of
// vertices that have moved are written.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ibmfair/io/mesh_file.h"
#include "ibmfair/io/ply.h"
#include "ibmfair/io/source_bytes.h"
#include "petsc_engine/mesh_piece.h"

namespace ibmfair::petsc {

class PlyRows {
 public:
  /// Takes the start of a file of `file_size` bytes, which has the header or more. Nothing where
  /// that announces anything but triangles in binary rows that are all of one size and fit into the
  /// file.
  static std::optional<PlyRows> find(const std::string& name, std::string_view start,
                                     std::int64_t file_size);

  std::int64_t vertices() const { return layout_.vertices().count; }
  std::int64_t triangles() const { return layout_.faces().count; }

  // Where the rows start, those of the first element and these, and bytes of each.
  std::int64_t first_row_offset() const { return static_cast<std::int64_t>(header_->size()); }
  std::int64_t vertex_offset() const { return vertex_offset_; }
  std::int64_t triangle_offset() const { return triangle_offset_; }
  std::int64_t vertex_row() const { return layout_.vertices().smallest_row(); }
  std::int64_t triangle_row() const { return triangle_row_; }

  /// What rows of vertices say; nothing where a coordinate is not finite.
  std::optional<std::vector<std::array<double, 3>>> positions(std::string_view rows) const;
  /// What rows of triangles say; nothing where one is no triangle of the file's vertices.
  std::optional<std::vector<std::array<Index, 3>>> corners(std::string_view rows) const;
  /// A property of the vertices; nothing where there is no scalar one of this name.
  std::optional<std::vector<double>> values(std::string_view rows, std::string_view name) const;
  /// The names of all scalar properties of the vertices.
  std::vector<std::string> property_names() const;

  bool has_texture_coordinates() const { return layout_.texture[0] >= 0; }

  /// How the file is written where a vertex of any rank has moved.
  struct Rewriting {
    std::string header;
    std::int64_t row = 0;            ///< bytes of a vertex
    std::vector<std::string> notes;  ///< what could not be kept, one sentence each
  };
  /// `row` is any one of the vertices.
  Rewriting rewriting(std::string_view row, WriteOptions::PlyReal real) const;

  /// The rows of the piece's own vertices, as they stand in the file, with these at X (#V of the
  /// piece x 3).
  std::string rewritten(std::string_view rows, const MeshPiece& piece, const Points& X,
                        WriteOptions::PlyReal real) const;

 private:
  PlyRows() = default;
  std::shared_ptr<const SourceBytes> lone_vertices(std::string_view rows, std::int64_t count) const;
  std::size_t no_corners() const;
  std::string_view vertices_of(const SourceBytes& written) const;
  std::string with_own_counts(std::string_view header) const;

  std::shared_ptr<const SourceBytes> header_;  // all views of the layout point into it
  ply::Layout layout_;
  std::int64_t vertex_offset_ = 0, triangle_offset_ = 0, triangle_row_ = 0;
};

}  // namespace ibmfair::petsc
