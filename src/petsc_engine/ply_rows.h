// Rows of binary PLY files of triangles: their offsets in the file, and how the rows of moved
// vertices are written.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ibmfair/io/formats.h"
#include "ibmfair/io/ply.h"
#include "ibmfair/io/source_bytes.h"
#include "petsc_engine/mesh_piece.h"

namespace ibmfair::petsc {

/// The types of the coordinates in the rows that are written.
struct RowTypes {
  CoordinateTypes types = CoordinateTypes::as_declared;  ///< not by_rounding
  std::string why_float64 = {};                          ///< the reason for float64
};

class PlyRows {
 public:
  /// `start` is the beginning of a file of `file_size` bytes, with at least the whole header.
  /// Returns nothing unless the header announces triangles in binary rows that all have the same
  /// size and fit into the file.
  static std::optional<PlyRows> find(const std::string& name, std::string_view start,
                                     std::int64_t file_size);

  std::int64_t vertices() const { return layout_.vertices().count; }
  std::int64_t triangles() const { return layout_.faces().count; }

  // Offsets (bytes) of the first element's rows, the vertex rows and the triangle rows; and the
  // sizes (bytes) of a vertex row and of a triangle row.
  std::int64_t first_row_offset() const { return static_cast<std::int64_t>(header_->size()); }
  std::int64_t vertex_offset() const { return vertex_offset_; }
  std::int64_t triangle_offset() const { return triangle_offset_; }
  std::int64_t vertex_row() const { return layout_.vertices().smallest_row(); }
  std::int64_t triangle_row() const { return triangle_row_; }

  /// Decodes rows of vertices; returns nothing if a coordinate is not finite.
  std::optional<std::vector<std::array<double, 3>>> positions(std::string_view rows) const;
  /// Decodes rows of triangles; returns nothing if a row is not a triangle of existing vertices.
  std::optional<std::vector<std::array<Index, 3>>> corners(std::string_view rows) const;
  /// Decodes a vertex property; returns nothing if there is no scalar property of this name.
  std::optional<std::vector<double>> values(std::string_view rows, std::string_view name) const;
  /// The names of all scalar properties of the vertices.
  std::vector<std::string> property_names() const;

  bool has_texture_coordinates() const { return layout_.texture[0] >= 0; }

  /// How the file is written if a vertex of any rank has moved.
  struct Rewriting {
    std::string header;
    std::int64_t row = 0;            ///< bytes of a vertex row
    std::vector<std::string> notes;  ///< one sentence for each kind of data that is lost
  };
  /// `row` is the row of any vertex.
  Rewriting rewriting(std::string_view row, const RowTypes& types) const;

  /// Takes the file's rows of the piece's own vertices, and returns the rows with the vertices at X
  /// (#V of the piece x 3).
  std::string rewritten(std::string_view rows, const MeshPiece& piece, const Points& X,
                        const RowTypes& types) const;

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
