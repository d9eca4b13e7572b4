// Files that killed runs leave where the file system cannot hold files without a name
// (ibmfair/io/atomic_file.h): `.ibmfair-PROCESS-NUMBER.tmp` beside the target.
#pragma once

#include <cstdint>
#include <limits>
#include <set>
#include <string>

#include <sys/types.h>

namespace ibmfair::commands {

/// Removes those that a process, which has ended, left in these folders. Processes of other
/// machines can have the same id: of one that ended there, what has changed since `end`, in
/// nanoseconds as FileStamp has them, is left alone.
void remove_temporaries_of(pid_t process, const std::set<std::string>& folders,
                           std::int64_t end = std::numeric_limits<std::int64_t>::max());

/// Removes those of all processes that are no longer there. With `shared`, processes of other
/// machines may be at work in the folders, and files younger than an hour are left alone. Returns
/// how many were removed.
int remove_stale_temporaries(const std::set<std::string>& folders, bool shared);

}  // namespace ibmfair::commands
