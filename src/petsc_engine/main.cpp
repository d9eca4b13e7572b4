// The part of ibmfair that distributes a mesh over the processes of mpirun. `ibmfair smooth ...
// --engine petsc` executes this program.
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <thread>

#include <petscksp.h>

#include "commands/command_line.h"
#include "commands/process.h"
#include "ibmfair/io/temporary_file.h"
#include "petsc_engine/petsc_options.h"
#include "petsc_engine/shared_smooth.h"

namespace ibmfair::petsc {
namespace {

/// Global because the declaration of the command is a plain function without this argument.
const Communicator* world = nullptr;

constexpr commands::Command shared_smooth{
    "smooth", "remove noise and ripples from a mesh that all ranks share",
    [](CLI::App& app) { return declare_shared_smooth(app, *world); }};

commands::ExitCode parse_and_run(const std::vector<std::string>& words, commands::Host& host) {
  commands::CommandLine line(shared_smooth);
  const bool tells = world->is_first();
  try {
    if (const auto answer = line.parse(words)) {
      commands::write_standard_output(tells ? *answer : std::string());
      return commands::ExitCode::done;
    }
  } catch (const commands::Misuse& misuse) {
    if (tells) {
      host.console().error(misuse.what());
      host.console().note(line.help_hint());
    }
    return commands::ExitCode::usage;
  }
  return line.run(host);
}

/// Whether all ranks reach this function within 5 s. Otherwise some ranks wait for a message
/// elsewhere.
bool all_get_here() {
  using namespace std::chrono_literals;
  const auto deadline = std::chrono::steady_clock::now() + 5s;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(world->get(), &request);
  int done = 0;
  while (done == 0 && std::chrono::steady_clock::now() < deadline) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    std::this_thread::sleep_for(1ms);
  }
  return done != 0;
}

/// Prints the exception being handled and returns its exit code. If all ranks have thrown, only the
/// first rank prints. If only some ranks have thrown, these print, and abort all ranks.
int print_or_abort(const commands::Console& console) {
  const auto code = static_cast<int>(commands::exit_code_of_current_exception());
  const bool agreed = all_get_here();
  if (world->is_first() || !agreed) {
    commands::print_current_exception(console);
  }
  if (!agreed) {
    remove_temporary_files();
    MPI_Abort(world->get(), code);
  }
  return code;
}

int run(const std::vector<std::string>& words) {
  commands::Host host;
  try {
    return static_cast<int>(parse_and_run(words, host));
  } catch (const Failure& failure) {
    if (world->is_first()) {
      host.console().error(failure.message());
    }
    return failure.code();
  } catch (...) {
    return print_or_abort(host.console());
  }
}

int run_with_petsc(int argc, char** argv) {
  commands::prepare_process();
  const SplitArguments arguments = split_arguments({argv + (argc > 0 ? 1 : 0), argv + argc});
  std::vector<std::string> words{"ibmfair", "-no_signal_handler"};
  words.insert(words.end(), arguments.petsc.begin(), arguments.petsc.end());
  std::vector<char*> pointers;
  for (std::string& word : words) {
    pointers.push_back(word.data());
  }
  pointers.push_back(nullptr);
  auto count = static_cast<int>(words.size());
  char** start = pointers.data();
  if (PetscInitialize(&count, &start, nullptr, nullptr) != 0) {
    return static_cast<int>(commands::ExitCode::internal_error);
  }
  PetscPushErrorHandler(PetscReturnErrorHandler, nullptr);
  int code = 0;
  {
    const Communicator comm(PETSC_COMM_WORLD);
    world = &comm;
    code = run(arguments.own);
  }
  PetscFinalize();
  return code;
}

}  // namespace
}  // namespace ibmfair::petsc

int main(int argc, char** argv) {
  return ibmfair::petsc::run_with_petsc(argc, argv);
}
