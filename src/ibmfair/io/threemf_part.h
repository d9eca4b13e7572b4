// One model part of a 3MF package: its objects, and where they are placed.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/io/source_bytes.h"

namespace ibmfair::threemf {

/// Maps a row vector x to x * A + t.
struct Transform {
  Eigen::Matrix3d A = Eigen::Matrix3d::Identity();
  Eigen::RowVector3d t = Eigen::RowVector3d::Zero();

  Eigen::RowVector3d operator()(const Eigen::RowVector3d& x) const { return x * A + t; }
};

/// First `inner`, then `outer`.
Transform combined(const Transform& inner, const Transform& outer);

/// An object that is placed by a component or by an item of the build.
struct Placement {
  std::string part;  ///< the part that holds the object; empty: this part
  std::int64_t object = 0;
  Transform transform;
};

/// Texture coordinates of a triangle's corners; group 0 stands for none.
struct TextureCorners {
  std::int64_t group = 0;
  std::array<Index, 3> row{};
};

struct Object {
  std::vector<std::array<double, 3>> X;
  std::vector<std::array<Index, 3>> F;  ///< corners are rows of X
  std::vector<TextureCorners> texture;  ///< #F
  std::vector<Placement> components;
};

struct Part {
  std::map<std::int64_t, Object> objects;
  std::map<std::int64_t, std::vector<std::array<double, 2>>> textures;  ///< by group
  std::vector<Placement> items;                                         ///< the build
  bool has_colours = false;  ///< colours or materials of triangles, which are not read
};

/// Parses a model part. Throws BadFile with line and column.
Part read_part(const SourceBytes& text);

}  // namespace ibmfair::threemf
