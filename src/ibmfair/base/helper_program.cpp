#include "ibmfair/base/helper_program.h"

#include <filesystem>
#include <system_error>

#include <dlfcn.h>

namespace ibmfair {
namespace {

/// The directory of the program or shared library that holds this code.
std::filesystem::path own_directory() {
  Dl_info info{};
  std::error_code error;
  std::filesystem::path own;
  if (dladdr(reinterpret_cast<const void*>(&find_helper), &info) != 0) {
    own = std::filesystem::canonical(info.dli_fname, error);
  }
  // For the main program, dladdr returns the name it was started with, which need not be a path.
  if (own.empty()) {
    own = std::filesystem::read_symlink("/proc/self/exe", error);
  }
  return own.parent_path();
}

}  // namespace

std::string find_helper(std::string_view name) {
  const std::filesystem::path own = own_directory();
  for (const std::filesystem::path& place :
       {own, own / "../libexec/ibmfair", std::filesystem::path(IBMFAIR_HELPER_DIRECTORY)}) {
    std::error_code error;
    if (std::filesystem::exists(place / name, error)) {
      return place / name;
    }
  }
  return {};
}

}  // namespace ibmfair
