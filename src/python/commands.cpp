// Runs a command of the command line on meshes in memory.
#include <pybind11/stl.h>

#include "arrays.h"
#include "bindings.h"
#include "commands/command_line.h"
#include "ibmfair/base/stopwatch.h"
#include "interpreter_lock.h"
#include "memory_host.h"
#include "text.h"

namespace py = pybind11;

namespace ibmfair::python {
namespace {

/// The result of a run, for ibmfair/_run.py.
py::dict result_of(Outcome outcome, const RunListener& listener, double seconds) {
  py::dict result;
  result["seconds"] = seconds;
  result["V"] = outcome.X ? py::object(array_of(std::move(*outcome.X))) : py::none();
  result["F"] = outcome.faces ? py::object(faces_of(*outcome.faces)) : py::none();
  result["merged"] = array_of(outcome.merged);
  result["figures"] = text_of(outcome.figures);
  result["warnings"] = texts_of(listener.warnings());
  result["notes"] = texts_of(listener.notes());
  result["error"] = listener.error();
  return result;
}

py::dict run(std::vector<std::string> words,
             const std::vector<std::pair<std::string, MeshFile>>& meshes, py::object progress) {
  std::vector<NamedMesh> named;
  for (const auto& [name, file] : meshes) {
    named.push_back({name, file});
  }
  RunListener listener(std::move(progress));
  Outcome outcome;
  MemoryHost host(std::move(named), listener, outcome);
  double seconds = 0;  // of the command, without the conversions
  {
    const Unlocked unlocked;
    const Stopwatch watch(seconds);
    try {
      commands::CommandLine line(words.front());
      line.parse(std::move(words));
      line.run(host);
    } catch (const Cancelled&) {  // the listener has the exception
    }
  }
  return result_of(std::move(outcome), listener, seconds);
}

}  // namespace

void bind_commands(py::module_& module) {
  module.def("run", &run, py::arg("words"), py::arg("meshes"), py::arg("progress"),
             "Runs a command on meshes that its arguments name.");
}

}  // namespace ibmfair::python
