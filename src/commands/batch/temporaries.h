// Removes the temporary files that killed runs leave on file systems without unnamed files
// (ibmfair/io/atomic_file.h). They are called `.ibmfair-PROCESS-NUMBER.tmp` and lie beside the
// target.
#pragma once

#include <cstdint>
#include <limits>
#include <set>
#include <string>

#include <sys/types.h>

namespace ibmfair::commands {

/// Removes the temporary files that `process`, which has ended, left in these folders. Files that
/// changed after `end` (nanoseconds, as in FileStamp) are kept: if the process ended on another
/// machine, a running process of this machine can have the same id.
void remove_temporaries_of(pid_t process, const std::set<std::string>& folders,
                           std::int64_t end = std::numeric_limits<std::int64_t>::max());

/// Removes the temporary files of all processes that no longer exist. If `shared`, processes of
/// other machines may be working in the folders, so files younger than an hour are kept. Returns
/// the number of removed files.
int remove_stale_temporaries(const std::set<std::string>& folders, bool shared);

}  // namespace ibmfair::commands
