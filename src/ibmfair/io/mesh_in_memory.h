// A mesh that comes from memory in place of a file.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "ibmfair/io/mesh_file.h"
#include "ibmfair/mesh/mesh.h"

namespace ibmfair {

/// A mesh in the memory of somebody else.
struct MeshView {
  std::span<const double> X;            ///< #V x 3, row by row
  std::span<const std::int64_t> first;  ///< as Polygons::first
  std::span<const Index> corner;        ///< as Polygons::corner
};

/// The mesh as a file called `name` in messages: the bytes are those of a binary PLY file in which
/// coordinates are double, so that every number is kept. Throws as read_mesh does.
MeshFile mesh_in_memory(const std::string& name, const MeshView& mesh);

}  // namespace ibmfair
