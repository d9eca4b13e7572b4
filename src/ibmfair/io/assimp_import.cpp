// Finds, loads and calls the assimp module.
#include "ibmfair/io/assimp_import.h"

#include <array>
#include <filesystem>

#include <dlfcn.h>
#include <fmt/format.h>

#include "ibmfair/io/source_bytes.h"

namespace ibmfair {
namespace {

constexpr const char* module_name = "libibmfair-assimp.so";

/// The directory of the program or shared library that holds this code.
std::filesystem::path own_directory() {
  Dl_info info{};
  std::error_code error;
  std::filesystem::path own;
  if (dladdr(reinterpret_cast<const void*>(&read_through_assimp), &info) != 0) {
    own = std::filesystem::canonical(info.dli_fname, error);
  }
  // dladdr gives the main program the name it was called by, which need not be a path.
  if (own.empty()) own = std::filesystem::read_symlink("/proc/self/exe", error);
  return own.parent_path();
}

/// Loads the module on the first call; a failure is remembered as its message.
class Module {
 public:
  Module() {
    const std::filesystem::path own = own_directory();
    const std::array<std::filesystem::path, 4> places{own, own / "ibmfair", own / "../lib/ibmfair",
                                                      IBMFAIR_MODULE_DIRECTORY};
    for (const std::filesystem::path& place : places) {
      const std::filesystem::path file = place / module_name;
      std::error_code error;
      if (!std::filesystem::exists(file, error)) continue;
      load(file.string());
      return;
    }
    problem_ = fmt::format("the module {} is not installed", module_name);
  }

  ImportFunction function() const { return function_; }
  const std::string& problem() const { return problem_; }

 private:
  void load(const std::string& file) {
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library != nullptr) {
      function_ = reinterpret_cast<ImportFunction>(dlsym(library, import_function_name));
    }
    if (function_ == nullptr) problem_ = dlerror();
  }

  ImportFunction function_ = nullptr;
  std::string problem_;
};

ImportedScene import_scene(const SourceBytes& source, const std::string& extension) {
  static const Module module;
  if (module.function() == nullptr) {
    fail_in_file(source,
                 fmt::format("reading this format needs assimp, which is missing ({}); OBJ, "
                             "PLY and OFF are read without it",
                             module.problem()));
  }
  ImportedScene scene;
  module.function()(source.view(), source.path(), extension, scene);
  if (!scene.error.empty()) fail_in_file(source, scene.error);
  return scene;
}

}  // namespace

ParsedMesh read_through_assimp(const SourceBytes& source, std::string_view extension) {
  ImportedScene scene = import_scene(source, std::string(extension));
  ParsedMesh parsed;
  parsed.mesh = std::move(scene.mesh);
  parsed.has_normals = scene.attributes.normals;
  parsed.has_texture_coordinates = !scene.attributes.texture_coordinates.empty();
  parsed.attributes = std::move(scene.attributes);
  parsed.notes.emplace_back(
      "read through assimp: coordinates are float32, and vertices and faces are numbered as its "
      "importer found them");
  if (scene.left_out_faces > 0) {
    parsed.notes.push_back(fmt::format("left out {} points and lines", scene.left_out_faces));
  }
  return parsed;
}

}  // namespace ibmfair
