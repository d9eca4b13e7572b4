// Reading a scene with assimp.
#pragma once

#include <string>

#include "assimp_helper/imported_scene.h"

namespace ibmfair {

class FolderFiles;

/// Reads the main file, only with importers that declare `extension`, and concatenates all meshes
/// of the scene, each mesh once for every node that refers to the mesh. Throws std::bad_alloc if
/// memory runs out.
ImportedScene import_scene(FolderFiles& files, const std::string& extension);

}  // namespace ibmfair
