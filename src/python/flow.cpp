// The flow, one step at a time. Its options are those of `ibmfair smooth --plain`.
#include <memory>
#include <mutex>
#include <utility>

#include <pybind11/stl.h>

#include "arrays.h"
#include "bindings.h"
#include "commands/command_line.h"
#include "commands/defect_warnings.h"
#include "commands/smooth_input.h"
#include "commands/smooth_run.h"
#include "ibmfair/flow/stepwise_flow.h"
#include "interpreter_lock.h"
#include "memory_host.h"
#include "text.h"

namespace py = pybind11;

namespace ibmfair::python {
namespace {

/// A host whose command leaves a flow here instead of writing a mesh.
class FlowHost final : public MemoryHost {
 public:
  using MemoryHost::MemoryHost;

  std::unique_ptr<StepwiseFlow> flow;
  commands::SmoothPlan plan;
};

commands::ExitCode prepare(const commands::SmoothArguments& arguments, commands::Host& host) {
  commands::Progress progress(host.console());
  const MeshFile file = read_input(arguments.input, arguments.reading, host);
  Points X = file.mesh().X;
  const Topology topology = build_topology(X, triangulate(file.mesh()).F);
  warn_of_defects(topology, arguments.strict, host.console());
  auto& here = dynamic_cast<FlowHost&>(host);
  here.plan = plan_smoothing(arguments, smooth_input(arguments, file, topology), progress);
  here.plan.fixed = prepare_for_flow(here.plan, topology, X);
  here.flow = std::make_unique<StepwiseFlow>(X, topology, here.plan.fixed, here.plan.flow);
  return commands::ExitCode::done;
}

constexpr commands::Command flow_command{
    "smooth", "prepare a flow", [](CLI::App& app) -> commands::Runner {
      auto arguments = std::make_shared<commands::SmoothArguments>();
      add_smooth_arguments(app, *arguments);
      return [arguments](commands::Host& host) { return prepare(*arguments, host); };
    }};

/// What one step did, under the names of the report's schema.
py::dict record_of(const StepRecord& step) {
  py::dict record;
  record["step"] = step.step;
  record["time"] = step.time;
  record["time_step"] = step.time_step;
  record["energy"] = step.energy;
  record["gradient_norm"] = step.gradient_norm;
  record["largest_move"] = step.largest_move;
  return record;
}

class Flow {
 public:
  Flow(std::vector<std::string> words, const std::string& name, const MeshFile& file) {
    RunListener listener((py::none()));
    Outcome outcome;
    FlowHost host({{name, file}}, listener, outcome);
    {
      const Unlocked unlocked;
      try {
        commands::CommandLine line(flow_command);
        line.parse(std::move(words));
        line.run(host);
      } catch (const Cancelled&) {  // the listener has the exception
      }
    }
    if (const py::object error = listener.error(); !error.is_none()) {
      PyErr_SetObject(py::type::handle_of(error).ptr(), error.ptr());
      throw py::error_already_set();
    }
    warnings_ = listener.warnings();
    fixed_ = std::move(host.plan.fixed);
    flow_ = std::move(host.flow);
  }

  py::object step() {
    std::optional<StepRecord> record;
    {
      const Unlocked unlocked;
      const std::lock_guard lock(mutex_);
      record = flow_->step();
    }
    return record ? py::object(record_of(*record)) : py::none();
  }

  py::array_t<double> positions() {
    Points X;
    {
      const Unlocked unlocked;
      const std::lock_guard lock(mutex_);
      X = flow_->positions();
    }
    return array_of(std::move(X));
  }

  void move_to(const Array<double>& V) {
    const Points X = points_of(V);
    const Unlocked unlocked;
    const std::lock_guard lock(mutex_);
    flow_->move_to(X);
  }

  double energy() const { return flow_->report().energy_after; }
  double time_step() const { return flow_->time_step(); }
  const std::string& solver() const { return flow_->report().solver; }
  int factorizations() const { return flow_->report().factorizations; }
  py::array_t<std::uint8_t> fixed() const { return array_of(fixed_); }
  py::list warnings() const { return texts_of(warnings_); }

 private:
  std::mutex mutex_;  // of the flow, while the interpreter's lock is released
  std::unique_ptr<StepwiseFlow> flow_;
  std::vector<std::uint8_t> fixed_;
  std::vector<std::string> warnings_;
};

}  // namespace

void bind_flow(py::module_& module) {
  py::class_<Flow>(module, "Flow")
      .def(py::init<std::vector<std::string>, const std::string&, const MeshFile&>())
      .def("step", &Flow::step)
      .def("positions", &Flow::positions)
      .def("move_to", &Flow::move_to)
      .def_property_readonly("energy", &Flow::energy)
      .def_property_readonly("time_step", &Flow::time_step)
      .def_property_readonly("solver", &Flow::solver)
      .def_property_readonly("factorizations", &Flow::factorizations)
      .def_property_readonly("fixed", &Flow::fixed)
      .def_property_readonly("warnings", &Flow::warnings);
}

}  // namespace ibmfair::python
