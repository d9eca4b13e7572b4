#include "memory_host.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/report/report.h"
#include "commands/report/report_formats.h"
#include "ibmfair/base/errors.h"
#include "interpreter_lock.h"

namespace py = pybind11;

namespace ibmfair::python {
namespace {

using namespace std::chrono_literals;
constexpr auto pause_between_questions = 50ms;

std::int64_t count_moved(const Points& before, const Points& after) {
  std::int64_t moved = 0;
  for (Eigen::Index v = 0; v < before.rows(); ++v) {
    moved += before.row(v) != after.row(v) ? 1 : 0;
  }
  return moved;
}

}  // namespace

RunListener::RunListener(py::object progress) : progress_(std::move(progress)) {}

RunListener::~RunListener() {
  Py_XDECREF(error_);
}

void RunListener::message(commands::MessageKind kind, std::string_view text) {
  const std::lock_guard lock(mutex_);
  (kind == commands::MessageKind::warning ? warnings_ : notes_).emplace_back(text);
}

void RunListener::progress(const commands::ProgressState& state) {
  if (std::this_thread::get_id() != caller_ || ends_) {
    return;
  }
  ask(&state);
  // After a step there is a state, and the flow asks whether it should end.
  if (ends_ && !state.energy) {
    throw Cancelled();
  }
}

bool RunListener::wants_end() {
  if (std::this_thread::get_id() == caller_ && !ends_) {
    ask(nullptr);
  }
  return ends_;
}

void RunListener::ask(const commands::ProgressState* state) {
  const bool tells = state != nullptr && !progress_.is_none();
  const Clock::time_point now = Clock::now();
  if (now - asked_ < pause_between_questions) {
    return;
  }
  asked_ = now;
  const Locked lock;
  try {
    if (PyErr_CheckSignals() != 0) {
      throw py::error_already_set();
    }
    if (tells) {
      call(progress_, py::make_tuple(state->stage, state->share));
    }
  } catch (py::error_already_set& error) {
    ends_ = true;
    error_ = error.value().inc_ref().ptr();
    PyException_SetTraceback(error_, error.trace() ? error.trace().ptr() : Py_None);
  }
}

py::object RunListener::error() const {
  return error_ == nullptr ? py::none() : py::reinterpret_borrow<py::object>(error_);
}

MemoryHost::MemoryHost(std::vector<NamedMesh> meshes, RunListener& listener, Outcome& outcome)
    : Host(listener), meshes_(std::move(meshes)), listener_(listener), outcome_(outcome) {}

MeshFile MemoryHost::read(const std::string& path, const ReadOptions& options) const {
  const auto mesh =
      std::ranges::find_if(meshes_, [&](const NamedMesh& known) { return known.name == path; });
  if (mesh == meshes_.end()) {
    throw BadOption(fmt::format("there is no mesh of the name '{}'", path));
  }
  return options.weld ? mesh->file.merged_exactly() : mesh->file;
}

void MemoryHost::require_writable(const MeshFile& /*source*/,
                                  const commands::OutputOptions& /*output*/) const {}

WriteReport MemoryHost::write(const MeshFile& source, const Points& X,
                              const commands::OutputOptions& /*output*/) const {
  return keep(source, X, nullptr);
}

WriteReport MemoryHost::write(const MeshFile& source, const Points& X, const Extension& extension,
                              const commands::OutputOptions& /*output*/) const {
  return keep(source, X, &extension);
}

WriteReport MemoryHost::write(const Mesh& mesh, const commands::OutputOptions& /*output*/) const {
  outcome_.X = mesh.X;
  outcome_.faces = mesh.faces;
  return {};
}

WriteReport MemoryHost::keep(const MeshFile& source, const Points& X,
                             const Extension* extension) const {
  const Mesh& mesh = source.mesh();
  outcome_.merged = source.merged_vertices();
  const Polygons& given = meshes_.front().file.mesh().faces;
  if (extension != nullptr || mesh.faces.first != given.first ||
      mesh.faces.corner != given.corner) {
    outcome_.faces = mesh.faces;
  }
  if (extension == nullptr) {
    outcome_.X = X;
  } else {
    outcome_.X.emplace(X.rows() + extension->X.rows(), 3);
    *outcome_.X << X, extension->X;
    for (Eigen::Index f = 0; f < extension->F.rows(); ++f) {
      outcome_.faces->add({extension->F.row(f).data(), 3});
    }
  }
  WriteReport report;
  report.moved_vertices = count_moved(mesh.X, X);
  return report;
}

void MemoryHost::deliver(const commands::ReportOptions& options, bool overwrite,
                         const commands::Report& report) const {
  commands::ReportOptions files = options;
  files.json = false;
  commands::deliver_report(files, overwrite, report);
  outcome_.figures = commands::line_of(commands::complete_figures(report, "-"));
}

bool MemoryHost::wants_end() const {
  return listener_.wants_end();
}

}  // namespace ibmfair::python
