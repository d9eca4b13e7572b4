// Reads the attributes of a few vertices and corners from an OBJ text.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/io/source_bytes.h"
#include "ibmfair/mesh/mesh.h"

namespace ibmfair::obj {

/// Reads the text once and parses only the requested parts, so it takes little more time than
/// copying the text.
class Excerpt {
 public:
  /// `vertices` and `corners` (of `mesh`, read from `source`) are in ascending order, each once.
  Excerpt(const SourceBytes& source, const Mesh& mesh, const std::vector<Index>& vertices,
          const std::vector<std::int64_t>& corners);

  /// #vertices x 4, the colour after x, y, z (three or four numbers); NaN for missing values.
  Eigen::MatrixXd colours;

  /// #corners each, the rows of the texture coordinates and normals; -1 if there are none.
  std::vector<Index> texture;
  std::vector<Index> normal;

  /// As MeshAttributes::face_statements.
  std::vector<std::pair<Index, std::string>> face_statements;

  Index texture_count() const { return static_cast<Index>(textures_.size()); }
  Index normal_count() const { return static_cast<Index>(normals_.size()); }

  /// The numbers of one row; NaN for one that is not a finite number.
  Eigen::RowVector2d texture_coordinate(Index row) const;
  Eigen::RowVector3d normal_vector(Index row) const;

 private:
  const SourceBytes& source_;
  std::vector<const char*> textures_;  // the start of each `vt` statement
  std::vector<const char*> normals_;   // the start of each `vn` statement
};

}  // namespace ibmfair::obj
