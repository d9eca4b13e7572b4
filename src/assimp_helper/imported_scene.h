// A scene as assimp read it, strung together into one mesh.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ibmfair {

/// Laid out as io/import_reply.h sends it.
struct ImportedScene {
  std::string error;                        ///< not empty: nothing was read
  std::vector<double> positions;            ///< 3 a vertex, node transforms applied
  std::vector<std::int64_t> first{0};       ///< face f has corners first[f] .. first[f + 1] - 1
  std::vector<std::int32_t> corner;         ///< vertex numbers
  std::vector<double> texture_coordinates;  ///< 2 a vertex; empty: none
  std::vector<double> colours;              ///< 4 a vertex; empty: none
  std::int64_t left_out_faces = 0;          ///< points and lines
  bool normals = false;

  std::size_t vertex_count() const { return positions.size() / 3; }
  std::size_t face_count() const { return first.size() - 1; }
};

}  // namespace ibmfair
