#include "commands/engine.h"

#include <cstdlib>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include "commands/argument_roles.h"
#include "commands/many_files.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/base/helper_program.h"

namespace ibmfair::commands {
namespace {

constexpr const char* engine_program = "ibmfair-petsc";
constexpr const char* engine_option = "--engine";
constexpr const char* single_engine = "single";
constexpr const char* petsc_engine = "petsc";

bool selects_petsc(const CLI::App& command) {
  return is_given(command, engine_option) &&
         command.get_option(engine_option)->results().back() == petsc_engine &&
         !takes_many_files(command);
}

}  // namespace

void add_engine_option(CLI::App& command, std::string& engine) {
  engine = single_engine;
  command
      .add_option(engine_option, engine,
                  "single: this process alone; petsc: all processes that mpirun starts share one "
                  "mesh; put PETSc's own options last")
      ->check(CLI::IsMember({single_engine, petsc_engine}))
      ->capture_default_str();
  command.allow_extras();  // PETSc's options; the command line rejects all others
}

bool passes_options_on(const CLI::App& command) {
  const std::vector<std::string> words = command.remaining();
  return selects_petsc(command) && !words.empty() && words.front().starts_with('-') &&
         !words.front().starts_with("--");
}

void become_engine(const CLI::App& command, const char* const* argv) {
  if (!selects_petsc(command)) {
    return;
  }
  if (const std::string program = find_helper(engine_program); !program.empty()) {
    // The BLAS that PETSc brings would start a thread for each core in each process. They spin, and
    // where memory is short, they never end.
    setenv("OPENBLAS_NUM_THREADS", "1", 0);
    execv(program.c_str(), const_cast<char* const*>(argv));
  }
}

void require_single_engine(const std::string& engine) {
  if (engine != single_engine) {
    throw BadOption(
        fmt::format("--engine {}: this part of the program, {}, is not installed; "
                    "built from source it needs PETSc and -D IBMFAIR_PETSC=ON",
                    engine, engine_program));
  }
}

}  // namespace ibmfair::commands
