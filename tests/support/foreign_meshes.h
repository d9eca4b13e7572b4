// Small files in formats that are imported by assimp.
#pragma once

#include <string>
#include <vector>

namespace ibmfair::test {

/// A file of one triangle: 0 0 0, 1 0 0, 0 1 0.
struct ForeignMesh {
  std::string extension;
  std::string bytes;
};

/// The triangle in many formats, both text and binary.
std::vector<ForeignMesh> foreign_triangles();

/// The triangle as glTF, with its coordinates in a buffer that has this URI.
std::string triangle_gltf(const std::string& uri);

/// The bytes of that buffer, and a data URI that contains these bytes.
std::string triangle_buffer();
extern const char* const triangle_data_uri;

/// Whether an imported file may refer to other files. The importer opens them with the system call
/// openat2, which Linux has since version 5.6, and which emulators of a processor may lack.
bool imports_can_refer_to_files();

}  // namespace ibmfair::test
