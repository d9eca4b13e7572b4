// Identifies this machine among the machines that use the same files.
#pragma once

#include <string>

namespace ibmfair::commands {

/// The host name, with characters other than letters, digits, `.` and `-` replaced by `_`, so that
/// it can be part of a file name. Another machine may have the same name.
std::string host_name();

/// Identifies the scope in which a process id refers to the same process: this boot of the machine
/// and this PID namespace (container). Empty if the system does not provide it.
std::string process_space();

}  // namespace ibmfair::commands
