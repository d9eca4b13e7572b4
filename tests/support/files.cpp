#include "support/files.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace ibmfair::test {

namespace {

namespace fs = std::filesystem;

fs::path shared_folder() {
  return fs::path(IBMFAIR_SOURCE_DIR).parent_path() / "shared" / "meshes";
}

}  // namespace

std::string read_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw std::runtime_error("cannot read " + path);
  }
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void write_bytes(const std::string& path, std::string_view bytes) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.flush();
  if (!file) {
    throw std::runtime_error("cannot write " + path);
  }
}

std::optional<std::string> shared_mesh(const std::string& name) {
  const fs::path path = shared_folder() / name;
  return fs::is_regular_file(path) ? std::optional(path.string()) : std::nullopt;
}

std::vector<std::string> shared_meshes(const std::string& folder) {
  std::vector<std::string> paths;
  const fs::path root = shared_folder() / folder;
  if (fs::is_directory(root)) {
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
      if (entry.is_regular_file()) {
        paths.push_back(entry.path().string());
      }
    }
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::vector<std::string> shared_meshes_below(std::uintmax_t bytes) {
  std::vector<std::string> paths;
  for (const std::string folder : {"models", "holes"}) {
    for (const std::string& path : shared_meshes(folder)) {
      if (fs::file_size(path) <= bytes) paths.push_back(path);
    }
  }
  return paths;
}

std::string project_file(const std::string& name) {
  return (fs::path(IBMFAIR_SOURCE_DIR) / name).string();
}

std::vector<std::string> project_meshes() {
  return {project_file("data/bunny.obj"), project_file("data/femur.off")};
}

}  // namespace ibmfair::test
