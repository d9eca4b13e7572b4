#include "ibmfair/io/assimp_import.h"

#include <filesystem>
#include <string>
#include <system_error>

#include <dlfcn.h>
#include <fmt/format.h>

#include "ibmfair/io/import_process.h"
#include "ibmfair/io/source_bytes.h"

namespace ibmfair {
namespace {

constexpr const char* helper_name = "ibmfair-assimp";
constexpr const char* without_it = "OBJ, PLY and OFF are read without it";

/// The directory of the program or shared library that holds this code.
std::filesystem::path own_directory() {
  Dl_info info{};
  std::error_code error;
  std::filesystem::path own;
  if (dladdr(reinterpret_cast<const void*>(&import_limits), &info) != 0) {
    own = std::filesystem::canonical(info.dli_fname, error);
  }
  // dladdr gives the main program the name it was called by, which need not be a path.
  if (own.empty()) own = std::filesystem::read_symlink("/proc/self/exe", error);
  return own.parent_path();
}

/// Empty where it is not installed.
std::string find_helper() {
  const std::filesystem::path own = own_directory();
  for (const std::filesystem::path& place :
       {own, own / "../libexec/ibmfair", std::filesystem::path(IBMFAIR_HELPER_DIRECTORY)}) {
    std::error_code error;
    if (std::filesystem::exists(place / helper_name, error)) return place / helper_name;
  }
  return {};
}

/// assimp tells binary glTF from text by its name alone.
std::string extension_for_assimp(const SourceBytes& source, std::string_view extension) {
  return std::string(source.view().starts_with("glTF") ? "glb" : extension);
}

}  // namespace

ImportLimits import_limits(std::size_t file_size) {
  const auto size = static_cast<std::int64_t>(file_size);
  return {std::chrono::seconds(10 + 4 * (size >> 20)), (std::int64_t{2} << 30) + 64 * size};
}

ParsedMesh read_through_assimp(const SourceBytes& source, std::string_view extension,
                               const ImportLimits& limits) {
  static const std::string helper = find_helper();
  if (helper.empty()) {
    fail_in_file(source, fmt::format("reading this format needs assimp, whose part {} is not "
                                     "installed; {}",
                                     helper_name, without_it));
  }
  try {
    ImportProcess process(
        helper,
        {source.path(), extension_for_assimp(source, extension), std::to_string(source.size()),
         std::to_string(limits.time.count()), std::to_string(limits.memory)},
        4 * limits.time);
    process.send(source.view());
    return receive_import(process, source, limits);
  } catch (const std::system_error& error) {
    fail_in_file(source, fmt::format("assimp cannot be started: {}; {}", error.what(), without_it));
  }
}

ParsedMesh read_through_assimp(const SourceBytes& source, std::string_view extension) {
  return read_through_assimp(source, extension, import_limits(source.size()));
}

}  // namespace ibmfair
