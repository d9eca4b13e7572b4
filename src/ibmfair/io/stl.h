// STL files.
#pragma once

#include <string>
#include <vector>

#include "ibmfair/io/formats.h"

namespace ibmfair::stl {

bool recognises(std::string_view bytes);

/// Reads the file through assimp. Throws BadFile, with the number of complete triangles, if the
/// file is truncated. Warns of an ASCII file without `endsolid`, and of bytes behind the last
/// triangle.
ParsedMesh read(const SourceBytes& source, std::string_view extension);

/// Writes binary STL: 50 bytes for each triangle, with the coordinates rounded to float32. Polygons
/// are cut into triangles. Throws BadMesh if a coordinate is beyond the range of float32.
std::vector<std::string> generate(const GenerateRequest& request, ByteSink& out);

}  // namespace ibmfair::stl
