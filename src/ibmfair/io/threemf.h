// 3MF files (3MF Core Specification 1.3, Production Extension 1.1, Materials Extension 1.2): zip
// packages with XML in them.
#pragma once

#include <string_view>

#include "ibmfair/io/formats.h"

namespace ibmfair::threemf {

bool recognises(std::string_view bytes);

/// Reads the objects of the build, placed as the build and the components place them. Coordinates
/// are exact where they are not transformed. Vertices and faces are numbered object by object, in
/// the order of the build. Texture coordinates are read; colours, materials, beams and slices are
/// not. Without items in the build, all objects are read that are no components of others. Throws
/// BadFile.
ParsedMesh read(const SourceBytes& source, std::string_view extension);

}  // namespace ibmfair::threemf
