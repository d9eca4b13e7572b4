// What the process owes its surroundings: signals and standard descriptors.
#pragma once

namespace ibmfair::commands {

/// Makes a write to a closed pipe an error instead of the end of the process, makes an interrupt
/// (SIGINT, SIGTERM, SIGHUP) end it with exit code 128 + signal, and makes sure that no file that
/// is opened later can take the place of a standard stream that the caller closed.
void prepare_process();

}  // namespace ibmfair::commands
