#include "commands/program.h"

#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "commands/command_line.h"
#include "commands/many_files.h"
#include "commands/process.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/base/instruction_set.h"

namespace ibmfair::commands {

namespace {

/// For finding out whether a result depends on the processor.
void choose_kernels() {
  const char* given = std::getenv(kernels_variable);
  const std::string_view name = given == nullptr ? "" : given;
  if (name == "baseline") {
    choose_kernel_set(InstructionSet::baseline);
  } else if (!name.empty() && name != "avx2") {
    throw BadOption(fmt::format("{}: '{}' is neither baseline nor avx2", kernels_variable, given));
  }
}

ExitCode parse_and_run(const std::vector<std::string>& words, Console& console) {
  CommandLine line(asks_for_many_files(words));
  try {
    if (const auto answer = line.parse(words)) {
      write_standard_output(*answer);
      return ExitCode::done;
    }
  } catch (const Misuse& misuse) {
    console.error(misuse.what());
    console.note(line.help_hint());
    return ExitCode::usage;
  }
  return line.run(console);
}

}  // namespace

int run_program(int argc, const char* const* argv) {
  prepare_process();
  Console console;
  ExitCode code = ExitCode::done;
  try {
    choose_kernels();
    code = parse_and_run({argv + (argc > 0 ? 1 : 0), argv + argc}, console);
  } catch (...) {
    const Failure failure = describe_current_exception();
    console.error(failure.message);
    code = failure.code;
  }
  return static_cast<int>(code);
}

}  // namespace ibmfair::commands
