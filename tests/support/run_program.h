// Runs the real program as its users do: arguments and bytes in, exit code and bytes out.
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
  broken_pipe,  ///< a pipe that nobody reads, as `| true`
  full          ///< /dev/full: every write fails for want of space
};

/// How long something may take that should take a moment. Nothing comes near it on a machine that
/// has time for the tests; on one that is given a tenth of a core, much comes near a minute.
inline constexpr std::chrono::seconds patience{600};

struct RunOptions {
  std::string input = {};  ///< bytes on standard input
  StandardOutput output = StandardOutput::captured;
  std::string directory = {};                 ///< working directory; empty: the test's own
  std::vector<std::string> environment = {};  ///< `NAME=value`, on top of the test's own
  std::chrono::seconds limit = patience;      ///< the program is killed after this long
  std::int64_t address_space = 0;  ///< bytes that the program may map (by prlimit); 0: no limit
  std::vector<std::string> limits = {};  ///< others, as prlimit takes them: `--fsize=1000`
  /// What starts the program, by its full name and with its arguments; empty: the test itself.
  std::vector<std::string> launcher = {};
  std::vector<int> closed = {};  ///< standard descriptors that the program starts without
  /// Sent once the program has taken the input, whose end it does not get to see; 0: none. Input of
  /// more than the 64 kB that a pipe holds makes sure that the program is reading by then.
  int signal_number = 0;
  /// If set, the signal is sent as soon as this is true, which is asked every few milliseconds, and
  /// the program sees the end of its input.
  std::function<bool()> signal_when = {};
};

struct RunResult {
  int exit_code = -1;  ///< negative: ended by that signal
  std::string out;
  std::string err;
  double cpu_seconds = 0;        ///< of all its threads, and of the processes that it waited for
  double peak_megabytes = 0;     ///< the most memory that it, or one of those, held at a time
  std::int64_t page_faults = 0;  ///< new pages of memory that it, and those, got from the system
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

/// Runs the program with these arguments, no shell in between. Throws std::runtime_error if it
/// cannot be started or does not end within the limit.
RunResult run_program(const std::vector<std::string>& arguments, const RunOptions& options = {});

/// Whether the program has the page of reports: it can be built without.
bool writes_pages();

}  // namespace ibmfair::test
