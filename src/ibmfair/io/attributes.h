// The contents of a mesh file besides positions and faces, in a form independent of the format.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// All members are optional: an empty list means that the file has no such data. All numbers are
/// finite: a value that is missing or not finite in the file is 0 here.
struct MeshAttributes {
  /// Texture coordinates; several corners may refer to the same row.
  std::vector<std::array<double, 2>> texture_coordinates;
  /// #corners, the row of `texture_coordinates` for each corner; -1 for a corner without one.
  std::vector<Index> corner_texture;

  /// Red, green, blue and opacity of each vertex, in 0 .. 1; #V.
  std::vector<std::array<double, 4>> colours;
  bool opacity = false;       ///< whether the file has opacities
  bool byte_colours = false;  ///< whether the file stores colours as integers 0 .. 255

  bool normals = false;  ///< the file has normals; writers recompute them

  /// The OBJ statements for groups, objects, materials and smoothing groups, each with the face
  /// that follows it.
  std::vector<std::pair<Index, std::string>> face_statements;

  /// Names of other data in the file that no other format can hold: "comments", "element edge", ...
  std::vector<std::string> uncarried;
};

}  // namespace ibmfair
