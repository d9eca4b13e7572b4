// What a command runs in when Python calls it: meshes come from memory and stay there, warnings and
// notes are collected, and nothing is printed.
#pragma once

#include <chrono>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <pybind11/pybind11.h>

#include "commands/host.h"
#include "commands/progress.h"

namespace ibmfair::python {

/// Thrown through a command that must end before it has a result. Not an exception of the library,
/// so that nothing but the caller catches it.
struct Cancelled {};

/// Collects messages, calls the caller's function with the progress, and notices Ctrl-C. All
/// members may be called without the interpreter's lock (GIL).
class RunListener final : public commands::Listener {
 public:
  /// `progress`: None, or a function of (stage, share).
  explicit RunListener(pybind11::object progress);
  ~RunListener() override;

  void message(commands::MessageKind kind, std::string_view text) override;

  /// Throws Cancelled if the computation should end and has no state to keep yet.
  void progress(const commands::ProgressState& state) override;

  /// Whether the caller has pressed Ctrl-C, or its function has raised an exception.
  bool wants_end();

  /// That exception, or None. The lock must be held.
  pybind11::object error() const;

  const std::vector<std::string>& warnings() const { return warnings_; }
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  using Clock = std::chrono::steady_clock;
  void ask(const commands::ProgressState* state);

  std::mutex mutex_;
  std::vector<std::string> warnings_, notes_;
  pybind11::object progress_;
  const std::thread::id caller_ = std::this_thread::get_id();
  Clock::time_point asked_ = {};
  bool ends_ = false;
  PyObject* error_ = nullptr;  // an exception; owned
};

/// What a command has written and reported.
struct Outcome {
  std::optional<Points> X;
  std::optional<Polygons> faces;  ///< set if they differ from those of the first mesh
  std::vector<Index> merged;      ///< MeshFile::merged_vertices of what was written
  std::string figures;            ///< JSON, by data/report.schema.json
};

struct NamedMesh {
  std::string name;
  MeshFile file;
};

class MemoryHost : public commands::Host {
 public:
  MemoryHost(std::vector<NamedMesh> meshes, RunListener& listener, Outcome& outcome);

  MeshFile read(const std::string& path, const ReadOptions& options) const override;
  void require_writable(const MeshFile& source,
                        const commands::OutputOptions& output) const override;
  WriteReport write(const MeshFile& source, const Points& X,
                    const commands::OutputOptions& output) const override;
  WriteReport write(const MeshFile& source, const Points& X, const Extension& extension,
                    const commands::OutputOptions& output) const override;
  WriteReport write(const Mesh& mesh, const commands::OutputOptions& output) const override;
  void deliver(const commands::ReportOptions& options, bool overwrite,
               const commands::Report& report) const override;
  bool wants_end() const override;

 private:
  WriteReport keep(const MeshFile& source, const Points& X, const Extension* extension) const;

  const std::vector<NamedMesh> meshes_;
  RunListener& listener_;
  Outcome& outcome_;
};

}  // namespace ibmfair::python
