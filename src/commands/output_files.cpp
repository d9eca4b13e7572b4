#include "commands/output_files.h"

#include <filesystem>
#include <map>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/io/atomic_file.h"

namespace ibmfair::commands {

namespace {

namespace fs = std::filesystem;

std::string description(const OutputFile& file) {
  return file.option.empty() ? "the output" : fmt::format("the file of {}", file.option);
}

}  // namespace

std::string file_identity(const std::string& path) {
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(fs::absolute(path, error), error);
  return error ? path : canonical.string();
}

bool is_special_file(const std::string& path) {
  std::error_code ignored;
  return fs::exists(path, ignored) && !fs::is_regular_file(path, ignored);
}

void check_output_files(const std::vector<OutputFile>& files, bool overwrite) {
  std::map<std::string, OutputFile> known;
  for (const OutputFile& file : files) {
    if (file.path.empty()) {
      continue;
    }
    const auto [place, added] = known.emplace(file_identity(file.path), file);
    if (!added && file.path != "-" && !is_special_file(file.path)) {
      throw BadOption(fmt::format("{}: '{}' is {} already", file.option, file.path,
                                  description(place->second)));
    }
    require_writable(file.path, overwrite);
  }
}

}  // namespace ibmfair::commands
