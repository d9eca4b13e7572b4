// What tells this machine from others that use the same files.
#pragma once

#include <string>

namespace ibmfair::commands {

/// What it is called, in characters that a file's name can have. Another may be called the same.
std::string host_name();

/// One word for where numbers of processes mean the same processes: this machine since it was
/// started and, in a container, there. Empty where the system does not say.
std::string process_space();

}  // namespace ibmfair::commands
