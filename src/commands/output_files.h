// The output files of one run.
#pragma once

#include <string>
#include <vector>

namespace ibmfair::commands {

struct OutputFile {
  std::string option;  ///< option that names the file, as `--report`; empty for OUT
  std::string path;
};

/// A unique name of a file that several paths can refer to, as `a/../b` and `b`.
std::string file_identity(const std::string& path);

/// Whether the path names a device or a pipe, which several items or options may write.
bool is_special_file(const std::string& path);

/// Checks the output files before the work starts. Throws BadOption if two entries are the same
/// file, and the exceptions of `require_writable` (ibmfair/io/atomic_file.h). Entries with an empty
/// path are ignored.
void check_output_files(const std::vector<OutputFile>& files, bool overwrite);

}  // namespace ibmfair::commands
