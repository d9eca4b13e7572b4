// Files that list vertices.
#pragma once

#include <string>
#include <vector>

#include "ibmfair/base/types.h"

namespace ibmfair::commands {

/// Reads vertex numbers, counted from 0, separated by white space or commas; `#` starts a comment.
/// If a number is malformed or not below `vertex_count`, throws BadFile with its line and text, and
/// with the option that names the file.
std::vector<Index> read_vertex_list(const std::string& option, const std::string& path,
                                    Index vertex_count);

}  // namespace ibmfair::commands
