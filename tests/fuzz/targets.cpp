#include "fuzz/targets.h"

#include <algorithm>

#include "support/files.h"

namespace ibmfair::fuzz {

namespace {

namespace fs = std::filesystem;

}  // namespace

std::span<const Target> targets() {
  static const std::vector<Target> table{
      {"read_obj", {"obj"}, read_obj},
      {"read_ply", {"ply"}, read_ply},
      {"read_off", {"off"}, read_off},
      {"read_3mf", {"3mf"}, read_3mf},
      {"write", {"obj", "ply", "off"}, write},
      {"command_line", {"arguments"}, command_line},
      {"batch_files", {"batch"}, batch_files},
      {"flow", {"flow"}, flow},
      {"fill", {"fill"}, fill},
  };
  return table;
}

const Target& find_target(std::string_view name) {
  const auto all = targets();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const Target& target) { return target.name == name; });
  if (found == all.end()) {
    throw std::out_of_range("no fuzz target is called '" + std::string(name) + "'");
  }
  return *found;
}

std::vector<fs::path> seed_folders(const Target& target) {
  const fs::path own = test::project_file("tests/fuzz");
  std::vector<fs::path> folders;
  const auto add = [&](const fs::path& folder) {
    if (fs::is_directory(folder)) folders.push_back(folder);
  };
  for (const std::string_view kind : target.kinds) {
    add(own / "corpus" / kind);
    const auto malformed = test::shared_meshes("malformed/" + std::string(kind));
    if (!malformed.empty()) add(fs::path(malformed.front()).parent_path());
  }
  add(own / "crashes" / target.name);
  return folders;
}

}  // namespace ibmfair::fuzz
