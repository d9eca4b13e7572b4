// Small files of formats that go through assimp.
#pragma once

#include <string>
#include <vector>

namespace ibmfair::test {

/// A file of one triangle: 0 0 0, 1 0 0, 0 1 0.
struct ForeignMesh {
  std::string extension;
  std::string bytes;
};

/// One for each of many formats, texts and binary ones.
std::vector<ForeignMesh> foreign_triangles();

/// The triangle as glTF, with its coordinates in a buffer of this address.
std::string triangle_gltf(const std::string& uri);

/// The bytes of that buffer, and an address that holds them itself.
std::string triangle_buffer();
extern const char* const triangle_data_uri;

/// Whether a file that is imported may refer to others. The importer opens them with the system
/// call openat2, which Linux has since version 5.6, and which emulators of a processor may lack.
bool imports_can_refer_to_files();

}  // namespace ibmfair::test
