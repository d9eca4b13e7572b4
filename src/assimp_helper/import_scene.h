// What assimp is asked to do.
#pragma once

#include <string>

#include "assimp_helper/imported_scene.h"

namespace ibmfair {

class FolderFiles;

/// Reads the main file with the importers that declare `extension`, and no others, and strings all
/// of its meshes together, once for every node that shows them. Throws std::bad_alloc for want of
/// memory.
ImportedScene import_scene(FolderFiles& files, const std::string& extension);

}  // namespace ibmfair
