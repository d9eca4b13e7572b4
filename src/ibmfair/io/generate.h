// What the writers that generate a file share.
#pragma once

#include <string>
#include <vector>

#include "ibmfair/io/attributes.h"
#include "ibmfair/mesh/mesh.h"

namespace ibmfair {

/// Whether every vertex has one texture coordinate (or none), whatever face looks at it.
bool texture_is_per_vertex(const Mesh& mesh, const MeshAttributes& attributes);

/// #V, the texture coordinate of each vertex; 0, 0 where it has none. Only where
/// texture_is_per_vertex.
std::vector<std::array<double, 2>> texture_per_vertex(const Mesh& mesh,
                                                      const MeshAttributes& attributes);

/// A colour channel as a whole number 0 .. 255.
int byte_colour(double value);

/// The note "FORMAT cannot hold, left out: ...", or nothing for an empty list.
std::vector<std::string> note_left_out(std::string_view format, std::vector<std::string> what);

}  // namespace ibmfair
