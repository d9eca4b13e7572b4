// A mesh that comes from memory, with named data at its vertices, in place of a file.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "ibmfair/io/mesh_file.h"
#include "ibmfair/mesh/mesh.h"

namespace ibmfair {

struct VertexProperty {
  std::string name;            ///< without white space
  std::vector<double> values;  ///< #V
};

/// The mesh as a file called `name` in messages: the bytes are those of a binary PLY file in which
/// coordinates and properties are double, so that every number is kept. Throws as read_mesh does.
MeshFile mesh_in_memory(const std::string& name, const Mesh& mesh,
                        std::span<const VertexProperty> properties = {});

}  // namespace ibmfair
