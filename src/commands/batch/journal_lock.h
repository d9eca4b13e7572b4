// Only one run at a time records in a journal. While a run records, it holds a lock on the journal,
// and a line of the journal tells others which process that is.
//
// The lock is one of flock(). It belongs to the open file: reading the journal elsewhere in the
// process does not release it, as it would release a lock of fcntl(F_SETLK), and child processes,
// in which the file is closed, do not hold it. The kernel releases it when the process ends,
// however it ends, so that a killed run leaves no lock behind.
//
// Linux sends flock() on NFS to the server as a lock of the whole file (flock(2), nfs(5)). With
// NFSv4 the lock holds between machines, and the server drops it when it has not heard of the
// machine for the lease time (90 s by default). With NFSv3 it holds between machines as well, but
// if the machine crashes, the server keeps the lock until the machine has started again. On mounts
// with `nolock` or `local_lock`, and on sshfs, it holds between the processes of one machine only.
// Some file systems have no locks (Lustre without `-o flock`).
#pragma once

#include <string>

namespace ibmfair::commands {

enum class JournalLock {
  held,             ///< by this process, until the descriptor is closed
  held_by_another,  ///< another run is recording
  not_supported     ///< the file system has no locks
};

/// Tries to lock the journal that is open as `fd`, without waiting.
JournalLock lock_journal(int fd);

/// The line, without line break, by which a run that holds the lock says who it is: machine,
/// process and time.
std::string line_of_this_run();

/// Says which run is recording in the journal at `path`, by the last line of that kind, and what
/// the user can do.
std::string message_about_other_run(const std::string& path);

}  // namespace ibmfair::commands
