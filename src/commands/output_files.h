// The files that one run writes.
#pragma once

#include <string>
#include <vector>

namespace ibmfair::commands {

struct OutputFile {
  std::string option;  ///< that names it, as `--report`; empty for the argument OUT
  std::string path;
};

/// The one name of a file that has many, as `a/../b` and `b`.
std::string file_identity(const std::string& path);

/// Whether the path names a device or a pipe, which can be written by everybody.
bool is_special_file(const std::string& path);

/// What can be wrong before the work starts: throws BadOption where two of them are one file, and
/// what `require_writable` (ibmfair/io/atomic_file.h) throws. Those without a path are left out.
void check_output_files(const std::vector<OutputFile>& files, bool overwrite);

}  // namespace ibmfair::commands
