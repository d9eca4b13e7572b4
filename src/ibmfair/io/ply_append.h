// Writes the rows of an extension, after the vertices and after the faces of a PLY file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ibmfair/io/attributes.h"
#include "ibmfair/io/ply.h"
#include "ibmfair/io/ply_row_writer.h"

namespace ibmfair::ply {

/// The bytes of a value in the file, and the end of the value before it.
struct Span {
  const char* before = nullptr;
  const char* first = nullptr;
  const char* last = nullptr;
};

/// The scalar in these bytes of the body; NaN if a text is not a finite number.
double number_at(const Span& span, Type type, Encoding encoding);

class VertexAppender {
 public:
  VertexAppender(const PatchRequest& request, const Layout& layout);

  /// Stores the needed values of a row of the source. Rows must come in order, with a span for each
  /// property.
  void see(std::int64_t row, const std::vector<Span>& spans);

  /// Writes the new rows. `stored` gives the type of each property in the output, or none for a
  /// property that is left out.
  void write(const std::vector<std::optional<Type>>& stored, RowWriter& row) const;

 private:
  /// Where the new values of a property come from.
  enum class Source : std::uint8_t { position, normal, extended, nearest, empty_list };
  Source source_of(std::size_t property) const;

  Eigen::RowVectorXd values_of(Index vertex) const;

  const PatchRequest& request_;
  const Layout& layout_;
  std::vector<Index> nearest_;
  std::vector<Index> wanted_;  // the rim and the nearest vertices, in ascending order
  Eigen::MatrixXd values_;     // #wanted x properties
  std::size_t next_ = 0;
};

/// Writes the rows of the new faces. If the file has triangle strips, each new face becomes a
/// strip.
class FaceAppender {
 public:
  /// Throws CannotWrite if the file has triangle strips with properties besides their vertices,
  /// because a new strip cannot take the values of those properties from a face.
  FaceAppender(const PatchRequest& request, const Layout& layout);

  /// Stores the needed values of a row of the source. Rows must come in order, with a span for each
  /// property.
  void see(std::int64_t row, const std::vector<Span>& spans);

  /// Writes the new rows with vertex numbers of type `index_type`. Returns notes.
  std::vector<std::string> write(Type index_type, RowWriter& row) const;

 private:
  void write_texture(const Property& property, Eigen::Index face, RowWriter& row) const;

  const PatchRequest& request_;
  const Layout& layout_;
  MeshAttributes texture_;                       // of all corners of faces, those of new faces last
  std::vector<Index> models_;                    // the model faces in ascending order
  std::vector<std::vector<std::string>> texts_;  // #models, the text of each property
};

}  // namespace ibmfair::ply
