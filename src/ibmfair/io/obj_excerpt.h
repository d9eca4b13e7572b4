// What an OBJ text says of a few of its vertices and corners.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/io/source_bytes.h"
#include "ibmfair/mesh/mesh.h"

namespace ibmfair::obj {

/// One pass over the text that parses nothing but what is asked for, and so takes little more time
/// than copying the text does.
class Excerpt {
 public:
  /// `vertices` and `corners` (of `mesh`, read from `source`) are in ascending order, each once.
  Excerpt(const SourceBytes& source, const Mesh& mesh, const std::vector<Index>& vertices,
          const std::vector<std::int64_t>& corners);

  /// #vertices x 4, the numbers that follow x, y, z where these are a colour; nan where not, or
  /// where there are fewer.
  Eigen::MatrixXd colours;

  /// #corners each, rows of the texture coordinates and normals; -1 where there are none.
  std::vector<Index> texture;
  std::vector<Index> normal;

  /// As MeshAttributes::face_statements.
  std::vector<std::pair<Index, std::string>> face_statements;

  Index texture_count() const { return static_cast<Index>(textures_.size()); }
  Index normal_count() const { return static_cast<Index>(normals_.size()); }

  /// The numbers of one row; nan for what is no finite number.
  Eigen::RowVector2d texture_coordinate(Index row) const;
  Eigen::RowVector3d normal_vector(Index row) const;

 private:
  const SourceBytes& source_;
  std::vector<const char*> textures_;  // where the `vt` statements begin
  std::vector<const char*> normals_;   // where the `vn` statements begin
};

}  // namespace ibmfair::obj
