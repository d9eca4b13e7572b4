// Removes the temporary files that killed runs leave on file systems without unnamed files
// (ibmfair/io/atomic_file.h). They are called `.ibmfair-PROCESS-NUMBER.tmp` and lie beside the
// target.
#pragma once

#include <set>
#include <string>

#include <sys/types.h>

namespace ibmfair::commands {

/// Removes the temporary files that `process`, which has ended, left in these folders.
void remove_temporaries_of(pid_t process, const std::set<std::string>& folders);

/// Removes the temporary files of all processes that no longer exist. If `others_work`, processes
/// of other machines may be working in the folders, so files younger than an hour are kept. Returns
/// the number of removed files.
int remove_stale_temporaries(const std::set<std::string>& folders, bool others_work);

}  // namespace ibmfair::commands
