// Finds the input files that a name or glob in a job refers to.
#pragma once

#include <string>
#include <vector>

namespace ibmfair::commands {

struct InputName {
  std::string path;
  bool by_glob = false;
};

/// The file with exactly the name `pattern`, if it exists; otherwise the sorted names that match
/// `pattern` as a glob (`*`, `?`, `[a-z]`, `{obj,ply}`, as in a shell). A name without glob
/// characters is returned as it is, whether or not the file exists. Throws BadFile for a glob
/// without matches.
std::vector<InputName> find_inputs(const std::string& pattern);

}  // namespace ibmfair::commands
