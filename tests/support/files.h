// Files that tests read and write.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ibmfair::test {

/// The bytes of a file; throws std::runtime_error if it cannot be read.
std::string read_bytes(const std::string& path);

/// Makes or replaces a file; throws std::runtime_error if it cannot be written.
void write_bytes(const std::string& path, std::string_view bytes);

/// The full paths of the meshes that ship with the project.
std::vector<std::string> project_meshes();

/// The full path of `name` (as `models/bunny.obj`) in the optional collection of real meshes beside
/// the project, `../shared/meshes`; nothing if the collection is absent. Tests then skip:
///     const auto path = shared_mesh("models/bunny.obj");
///     if (!path) GTEST_SKIP() << "no ../shared/meshes";
std::optional<std::string> shared_mesh(const std::string& name);

/// All files below a folder of the collection of real meshes, sorted by name; empty if the
/// collection is absent.
std::vector<std::string> shared_meshes(const std::string& folder);

/// The closed and the open surfaces of the collection whose files have at most this many bytes.
std::vector<std::string> shared_meshes_below(std::uintmax_t bytes);

/// The full path of a file in the project, as `data/README.md`.
std::string project_file(const std::string& name);

}  // namespace ibmfair::test
