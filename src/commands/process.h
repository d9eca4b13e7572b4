// Set-up of the process: signals, standard descriptors, memory.
#pragma once

namespace ibmfair::commands {

/// The environment variable with the id of the parent process, for a process that must not outlive
/// its parent.
inline constexpr const char* parent_variable = "IBMFAIR_PARENT";

/// Installs the signal handlers (commands/signals.h). Opens a placeholder for every standard stream
/// that the caller closed, so that a file opened later cannot take its descriptor. If the process
/// belongs to a batch, the kernel will kill the process when the batch ends for any reason. The
/// process keeps freed memory for reuse, uses large pages, and ends the threads of the BLAS, so
/// that only the threads of our own loops remain.
void prepare_process();

}  // namespace ibmfair::commands
