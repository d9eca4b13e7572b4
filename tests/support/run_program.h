// Runs the real program as its users do: the test gives arguments and bytes, and receives an exit
// code and bytes.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace ibmfair::test {

enum class StandardOutput {
  captured,
  closed,       ///< as `>&-` in a shell
  broken_pipe,  ///< a pipe that nobody reads, as in `| true`
  full          ///< /dev/full: every write fails because the device is full
};

/// The time limit for a run that should take a moment. On a machine that has time for the tests, no
/// run comes near this limit; on a machine that gives the tests a tenth of a core, many runs take
/// nearly a minute.
inline constexpr std::chrono::seconds patience{600};

struct RunOptions {
  std::string input = {};  ///< bytes on standard input
  StandardOutput output = StandardOutput::captured;
  std::string directory = {};                 ///< working directory; empty: the test's own
  std::vector<std::string> environment = {};  ///< `NAME=value`, on top of the test's own
  std::chrono::seconds limit = patience;      ///< the program is killed after this long
  std::int64_t address_space = 0;  ///< bytes that the program may map (set by prlimit); 0: no limit
  std::vector<std::string> limits = {};  ///< other limits, as prlimit takes them: `--fsize=1000`
  /// The command that starts the program: its full name and its arguments. If empty, the test
  /// itself starts the program.
  std::vector<std::string> launcher = {};
  std::vector<int> closed = {};  ///< standard descriptors that the program starts without
  /// The signal that is sent after the program has taken the input; the program does not see the
  /// end of the input. 0: no signal. If the input is longer than the 64 kB that a pipe holds, the
  /// program is certainly reading by then.
  int signal_number = 0;
  /// If set, the signal is sent as soon as this function returns true; it is called every few
  /// milliseconds. In this case the program sees the end of its input.
  std::function<bool()> signal_when = {};
};

struct RunResult {
  int exit_code = -1;  ///< negative: the program was ended by that signal
  std::string out;
  std::string err;
  double cpu_seconds = 0;        ///< of all threads and of the processes that were waited for
  double peak_megabytes = 0;     ///< the most memory that any one process held
  std::int64_t page_faults = 0;  ///< new pages of memory, with the processes waited for
};

using Words = std::vector<std::string>;
Words operator+(Words a, const Words& b);

bool contains(const std::string& text, const std::string& part);

/// The full name of the program under test.
std::string program_path();

/// Whether the tests and the program run in an emulator of another processor (`tools/test
/// --arm64`). The emulator needs memory of its own within the limits that a test sets for the
/// program, and it lacks some calls of the system.
bool runs_in_emulator();

/// Runs the program with these arguments, without a shell in between. Throws std::runtime_error if
/// the program cannot be started or does not end within the limit.
RunResult run_program(const std::vector<std::string>& arguments, const RunOptions& options = {});

/// Whether the program has the page for reports: it can be built without this page.
bool writes_pages();

}  // namespace ibmfair::test
