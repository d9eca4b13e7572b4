// The program: from its arguments to its exit code.
#pragma once

namespace ibmfair::commands {

/// The variable in the environment that says for which instructions our own kernels shall be those
/// compiled: `baseline` for what every processor has, `avx2` or `avx512` for that at most. Without
/// it they are the best that the processor has.
inline constexpr const char* kernels_variable = "IBMFAIR_KERNELS";

/// Parses the arguments by the table of commands, runs the one that they name, and tells on
/// standard error what went wrong. Returns the exit code.
int run_program(int argc, const char* const* argv);

}  // namespace ibmfair::commands
