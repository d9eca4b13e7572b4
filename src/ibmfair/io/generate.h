// Functions shared by the writers that generate a file.
#pragma once

#include <string>
#include <vector>

#include "ibmfair/io/attributes.h"
#include "ibmfair/mesh/mesh.h"

namespace ibmfair {

/// Whether all corners at a vertex have the same texture coordinate (or none), for every vertex.
bool texture_is_per_vertex(const Mesh& mesh, const MeshAttributes& attributes);

/// The texture coordinate of each vertex, #V; (0, 0) if the vertex has none.
/// texture_is_per_vertex() must hold.
std::vector<std::array<double, 2>> texture_per_vertex(const Mesh& mesh,
                                                      const MeshAttributes& attributes);

/// Converts a colour channel in 0 .. 1 to an integer in 0 .. 255.
int byte_colour(double value);

/// The note "FORMAT cannot hold, left out: ...", or nothing for an empty list.
std::vector<std::string> note_left_out(std::string_view format, std::vector<std::string> what);

}  // namespace ibmfair
