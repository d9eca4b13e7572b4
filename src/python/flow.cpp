// The flow, one step at a time. Its options are those of `ibmfair smooth --plain`.
#include <memory>
#include <utility>

#include <pybind11/stl.h>

#include "bindings.h"
#include "commands/command_line.h"
#include "commands/smooth_input.h"
#include "ibmfair/flow/stepwise_flow.h"
#include "memory_host.h"

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
  const Topology topology = build_topology(file.mesh().X, triangulate(file.mesh()).F);
  auto& here = dynamic_cast<FlowHost&>(host);
  here.plan = plan_smoothing(arguments, smooth_input(arguments, file, topology), progress);
  here.flow =
      std::make_unique<StepwiseFlow>(file.mesh().X, topology, here.plan.fixed, here.plan.flow);
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
  Flow(std::vector<std::string> words, const py::tuple& mesh) {
    RunListener listener((py::none()));
    Outcome outcome;
    FlowHost host({named_mesh_of(mesh)}, listener, outcome);
    {
      const py::gil_scoped_release unlocked;
      commands::CommandLine line(flow_command);
      line.parse(std::move(words));
      line.run(host);
    }
    warnings_ = listener.warnings();
    fixed_ = std::move(host.plan.fixed);
    flow_ = std::move(host.flow);
  }

  py::object step() {
    std::optional<StepRecord> record;
    {
      const py::gil_scoped_release unlocked;
      record = flow_->step();
    }
    return record ? py::object(record_of(*record)) : py::none();
  }

  py::array_t<double> positions() const { return array_of(flow_->positions()); }
  void move_to(const Array<double>& V) { flow_->move_to(points_of(V)); }
  double energy() const { return flow_->report().energy_after; }
  double time_step() const { return flow_->time_step(); }
  const std::string& solver() const { return flow_->report().solver; }
  int factorizations() const { return flow_->report().factorizations; }
  py::array_t<std::uint8_t> fixed() const { return array_of(fixed_); }
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  std::unique_ptr<StepwiseFlow> flow_;
  std::vector<std::uint8_t> fixed_;
  std::vector<std::string> warnings_;
};

}  // namespace

void bind_flow(py::module_& module) {
  py::class_<Flow>(module, "Flow")
      .def(py::init<std::vector<std::string>, const py::tuple&>())
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
