// The files that a name in a job stands for.
#pragma once

#include <string>
#include <vector>

namespace ibmfair::commands {

struct InputName {
  std::string path;
  bool by_glob = false;
};

/// The file of that very name if there is one; otherwise what it finds as a glob (`*`, `?`,
/// `[a-z]`,
/// `{obj,ply}`, as a shell has them), sorted. A name without such characters stands for itself.
/// Throws BadFile for a glob that finds nothing.
std::vector<InputName> find_inputs(const std::string& pattern);

}  // namespace ibmfair::commands
