#include "commands/batch/input_names.h"

#include <filesystem>

#include <fmt/format.h>
#include <glob.h>

#include "ibmfair/base/errors.h"

namespace ibmfair::commands {

namespace {

class Glob {
 public:
  explicit Glob(const std::string& pattern)
      : result_(glob(pattern.c_str(), GLOB_BRACE | GLOB_TILDE, nullptr, &found_)) {}
  ~Glob() { globfree(&found_); }
  Glob(const Glob&) = delete;
  Glob& operator=(const Glob&) = delete;

  std::vector<InputName> files() const {
    std::vector<InputName> names;
    for (std::size_t i = 0; result_ == 0 && i < found_.gl_pathc; ++i) {
      if (!std::filesystem::is_directory(found_.gl_pathv[i])) {
        names.push_back({found_.gl_pathv[i], true});
      }
    }
    return names;
  }

 private:
  glob_t found_{};
  int result_;
};

}  // namespace

std::vector<InputName> find_inputs(const std::string& pattern) {
  std::error_code ignored;
  const bool is_glob = pattern.find_first_of("*?[{") != std::string::npos;
  if (!is_glob || std::filesystem::exists(pattern, ignored)) {
    return {{pattern, false}};
  }
  std::vector<InputName> names = Glob(pattern).files();
  if (names.empty()) {
    throw BadFile(fmt::format("no file matches '{}'", pattern));
  }
  return names;
}

}  // namespace ibmfair::commands
