// Every format that is not our own, read through assimp. The importer lives in a shared module of
// its own that is loaded when it is first needed: starting the program does not pay for it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ibmfair/io/formats.h"

namespace ibmfair {

/// What the module hands over: the scene's meshes one after the other, node transforms applied.
struct ImportedScene {
  Mesh mesh;
  MeshAttributes attributes;
  std::string error;                ///< not empty: nothing was read
  std::int64_t left_out_faces = 0;  ///< points and lines
};

/// Reads the file through assimp. Throws BadFile where assimp or the module is missing, and where
/// assimp refuses the file. `extension` tells assimp the format of standard input.
ParsedMesh read_through_assimp(const SourceBytes& source, std::string_view extension);

/// The module's one function, found by name. `path` is empty for bytes that come from no file; with
/// a path, files that it refers to are found beside it.
constexpr const char* import_function_name = "ibmfair_import_scene";
using ImportFunction = void (*)(std::string_view bytes, const std::string& path,
                                const std::string& extension, ImportedScene& scene);

}  // namespace ibmfair
