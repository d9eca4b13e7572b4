#include <nlohmann/json.hpp>

#include "bindings.h"
#include "commands/command_line.h"
#include "ibmfair/base/instruction_set.h"
#include "ibmfair/base/version.h"
#include "interpreter_lock.h"

PYBIND11_MODULE(_core, module) {
  using namespace ibmfair;
  choose_kernel_set_by_environment();
  module.doc() = "The part of ibmfair that is written in C++; see the package ibmfair.";
  module.attr("version") = version();
  module.def(
      "usage",
      [] { return commands::CommandLine().parse({"--json-usage"}).value_or(std::string()); },
      "The options of all commands as JSON: what `ibmfair --json-usage` prints.");
  python::bind_interpreter_end();
  python::bind_errors(module);
  python::bind_commands(module);
  python::bind_flow(module);
  python::bind_energies(module);
  python::bind_files(module);
}
