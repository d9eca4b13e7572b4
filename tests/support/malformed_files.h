// Odd, broken and hostile mesh files, each with what the program must make of it. They show every
// kind of fault that was found in files of others.
#pragma once

#include <string>
#include <vector>

#include "support/malformed_outcomes.h"

namespace ibmfair::test {

struct MalformedFile {
  std::string name;  ///< the kind of fault, and the format: `zero_byte.obj`
  std::string bytes;
  CommandOutcomes outcomes;
};

/// The files in a format: `obj`, `off`, `ply` or `stl`. All are small (below 200 kB).
std::vector<MalformedFile> malformed_files(const std::string& format);

}  // namespace ibmfair::test
