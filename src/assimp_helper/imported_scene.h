// A scene that assimp has read, concatenated into one mesh.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ibmfair {

/// The arrays have the layout in which io/import_reply.h sends them.
struct ImportedScene {
  std::string error;                        ///< if not empty, nothing was read
  std::vector<double> positions;            ///< 3 per vertex, node transforms applied
  std::vector<std::int64_t> first{0};       ///< face f has corners first[f] .. first[f + 1] - 1
  std::vector<std::int32_t> corner;         ///< vertex numbers
  std::vector<double> texture_coordinates;  ///< 2 per vertex, or empty
  std::vector<double> colours;              ///< 4 per vertex, or empty
  std::int64_t left_out_faces = 0;          ///< number of points and lines that were left out
  bool normals = false;

  std::size_t vertex_count() const { return positions.size() / 3; }
  std::size_t face_count() const { return first.size() - 1; }
};

}  // namespace ibmfair
