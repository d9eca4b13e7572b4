#include "commands/engine.h"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>
#include <unistd.h>

#include "commands/many_files.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/base/helper_program.h"

namespace ibmfair::commands {
namespace {

constexpr const char* engine_program = "ibmfair-petsc";
constexpr const char* engine_option = "--engine";

bool asks_for_petsc(const std::vector<std::string>& words) {
  const std::string joined = std::string(engine_option) + "=" + petsc_engine;
  const auto option = std::find(words.begin(), words.end(), engine_option);
  return std::find(words.begin(), words.end(), joined) != words.end() ||
         (option != words.end() && option + 1 != words.end() && *(option + 1) == petsc_engine);
}

}  // namespace

void become_engine(const std::vector<std::string>& words, const char* const* argv) {
  if (words.empty() || words.front() != "smooth" || !asks_for_petsc(words) ||
      asks_for_many_files(words)) {
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
