#include "ibmfair/io/assimp_import.h"

#include <string>
#include <system_error>

#include <fmt/format.h>

#include "ibmfair/base/helper_program.h"
#include "ibmfair/io/import_process.h"
#include "ibmfair/io/source_bytes.h"

namespace ibmfair {
namespace {

constexpr const char* helper_name = "ibmfair-assimp";
constexpr const char* without_it = "OBJ, PLY, OFF and 3MF files are read without it";

/// The extension to give to assimp, which tells binary glTF from text glTF by the name alone.
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
  static const std::string helper = find_helper(helper_name);
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
