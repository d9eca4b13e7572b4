#include "commands/program.h"

#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "commands/command_line.h"
#include "commands/engine.h"
#include "commands/process.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/base/instruction_set.h"
#include "ibmfair/io/temporary_file.h"

namespace ibmfair::commands {

namespace {

ExitCode parse_and_run(int argc, const char* const* argv, Host& host) {
  CommandLine line;
  try {
    const std::vector<std::string> words{argv + (argc > 0 ? 1 : 0), argv + argc};
    if (const auto answer = line.parse(words)) {
      write_standard_output(*answer);
      return ExitCode::done;
    }
  } catch (const Misuse& misuse) {
    host.console().error(misuse.what());
    host.console().note(line.help_hint(), line.first_commands());
    return ExitCode::usage;
  }
  become_engine(line.command(), argv);
  return line.run(host);
}

/// The terminate handler: libraries may throw std::bad_alloc from a noexcept function.
[[noreturn]] void end_by_exception() {
  if (!std::current_exception()) {
    std::abort();
  }
  remove_temporary_files();
  std::_Exit(static_cast<int>(print_current_exception(Console())));
}

}  // namespace

int run_program(int argc, const char* const* argv) {
  std::set_terminate(end_by_exception);
  prepare_process();
  Host host;
  ExitCode code = ExitCode::done;
  try {
    choose_kernel_set_by_environment();
    code = parse_and_run(argc, argv, host);
  } catch (...) {
    code = print_current_exception(host.console());
  }
  return static_cast<int>(code);
}

}  // namespace ibmfair::commands
