// The rows that an extension puts behind the vertices and the faces of a PLY file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ibmfair/io/attributes.h"
#include "ibmfair/io/ply.h"
#include "ibmfair/io/ply_row_writer.h"

namespace ibmfair::ply {

/// Where a value stands in the file, and where the one before it ended.
struct Span {
  const char* before = nullptr;
  const char* first = nullptr;
  const char* last = nullptr;
};

/// The scalar at a place of the body; nan where a text is no finite number.
double number_at(const Span& span, Type type, Encoding encoding);

class VertexAppender {
 public:
  VertexAppender(const PatchRequest& request, const Layout& layout);

  /// Takes what it needs of a row of the source; rows come in order, a span for each property.
  void see(std::int64_t row, const std::vector<Span>& spans);

  /// Writes the new rows. `stored` has the type of each property in the file written; none for
  /// those left out.
  void write(const std::vector<std::optional<Type>>& stored, RowWriter& row) const;

 private:
  /// What a property's new values are.
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

/// Triangle strips get a strip of its own for each new face.
class FaceAppender {
 public:
  /// Throws CannotWrite for strips that have properties besides their vertices, which no new strip
  /// could take from a face.
  FaceAppender(const PatchRequest& request, const Layout& layout);

  /// Takes what it needs of a row of the source; rows come in order, a span for each property.
  void see(std::int64_t row, const std::vector<Span>& spans);

  /// Writes the new rows with vertex numbers of type `index_type`. Returns notes.
  std::vector<std::string> write(Type index_type, RowWriter& row) const;

 private:
  void write_texture(const Property& property, Eigen::Index face, RowWriter& row) const;

  const PatchRequest& request_;
  const Layout& layout_;
  MeshAttributes texture_;                       // of the faces' corners, those of new faces last
  std::vector<Index> models_;                    // in ascending order
  std::vector<std::vector<std::string>> texts_;  // #models, of each property
};

}  // namespace ibmfair::ply
