#include "ibmfair/solve/cholmod_library.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/process_memory.h"

namespace ibmfair {
namespace {

constexpr const char* library_name = IBMFAIR_CHOLMOD_LIBRARY;

/// Sets variables to "1" for its own lifetime, except for those that are set already.
class OneThread {
 public:
  OneThread() {
    for (const char* name : names) {
      if (std::getenv(name) == nullptr && setenv(name, "1", 0) == 0) own_.push_back(name);
    }
  }
  ~OneThread() {
    for (const char* name : own_) {
      unsetenv(name);
    }
  }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  // What OpenBLAS, MKL, BLIS, Apple's Accelerate and OpenMP read when they are loaded. CHOLMOD's
  // loops ask OpenMP for four threads, which takes two to three times as long as one thread where
  // there are two cores.
  static constexpr std::array names{"OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "BLIS_NUM_THREADS",
                                    "VECLIB_MAXIMUM_THREADS", "OMP_THREAD_LIMIT"};
  std::vector<const char*> own_;
};

class Library {
 public:
  Library() : handle_(load()) {
    get("cholmod_l_start", functions_.start);
    get("cholmod_l_finish", functions_.finish);
    get("cholmod_l_analyze_p", functions_.analyze_p);
    get("cholmod_l_factorize", functions_.factorize);
    get("cholmod_l_solve2", functions_.solve2);
    get("cholmod_l_free_factor", functions_.free_factor);
    get("cholmod_l_free_dense", functions_.free_dense);
    get("cholmod_version", functions_.version);
  }

  const CholmodFunctions& functions() const { return functions_; }

  /// A function of CHOLMOD or of a library that it brings, or null.
  template <class Function>
  Function* find(const char* name) const {
    return reinterpret_cast<Function*>(dlsym(handle_, name));
  }

 private:
  static void* load() {
    // OpenBLAS tries for ever to get its buffer.
    constexpr double address_space = 250e6;
    if (std::isfinite(address_space_limit())) {
      require_available(address_space, "CHOLMOD with its BLAS");
    }
    const OneThread environment;
    void* const handle = dlopen(library_name, RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr) refuse(dlerror());
    return handle;
  }

  [[noreturn]] static void refuse(std::string_view why) {
    throw BadOption(fmt::format(
        "CHOLMOD cannot be loaded ({}): install SuiteSparse, or take --solver multifrontal, "
        "which gives the same results",
        why));
  }

  template <class Function>
  void get(const char* name, Function*& function) {
    function = find<Function>(name);
    if (function == nullptr) refuse(fmt::format("{} has no {}", library_name, name));
  }

  void* handle_;  // stays open until the process ends
  CholmodFunctions functions_{};
};

const Library& library() {
  static const Library loaded;
  return loaded;
}

/// The name of the BLAS as it calls itself, if it is one that does so, and its file.
std::string describe_blas() {
  std::string text;
  if (const auto config = library().find<const char*()>("openblas_get_config")) {
    text = config();
  }
  Dl_info info{};
  const auto dgemm = library().find<void()>("dgemm_");
  const bool is_known =
      dgemm != nullptr && dladdr(reinterpret_cast<const void*>(dgemm), &info) != 0;
  if (is_known && info.dli_fname != nullptr) {
    std::error_code error;
    const std::filesystem::path file = std::filesystem::canonical(info.dli_fname, error);
    const std::string path = error ? info.dli_fname : file.string();
    text = text.empty() ? path : fmt::format("{} ({})", text, path);
  }
  return text.empty() ? "unknown" : text;
}

}  // namespace

const CholmodFunctions& cholmod_functions() {
  return library().functions();
}

std::vector<Component> cholmod_components() {
  std::array<int, 3> version{};
  cholmod_functions().version(version.data());
  return {{"CHOLMOD", fmt::format("{}", fmt::join(version, "."))}, {"BLAS", describe_blas()}};
}

}  // namespace ibmfair
