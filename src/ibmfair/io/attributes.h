// What a mesh file may hold beyond positions and faces, in terms that any format can take up.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// Everything here is optional: an empty list says that the file has none of it. All numbers are
/// finite: what is not in the file is 0 here.
struct MeshAttributes {
  /// Texture coordinates, shared by corners; a corner without one has -1.
  std::vector<std::array<double, 2>> texture_coordinates;
  std::vector<Index> corner_texture;  ///< #corners, rows of `texture_coordinates`

  /// Red, green, blue and opacity of each vertex, 0 .. 1; #V.
  std::vector<std::array<double, 4>> colours;
  bool opacity = false;       ///< whether the fourth value means something
  bool byte_colours = false;  ///< whether the file counts 0 .. 255 in whole steps

  bool normals = false;  ///< the file has normals; they are recomputed, never carried over

  /// OBJ groups, objects, materials and smoothing groups: a line and the face that it precedes.
  std::vector<std::pair<Index, std::string>> face_statements;

  /// What else the file has and no other format can take: "comments", "element edge", ...
  std::vector<std::string> uncarried;
};

}  // namespace ibmfair
