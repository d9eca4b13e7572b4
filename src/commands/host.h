// What a command runs in: who is told what, and where meshes and reports come from and go to. The
// program's host reads and writes files and prints. The Python module has a host of its own, which
// keeps meshes in memory.
#pragma once

#include <string>

#include "commands/console.h"
#include "commands/shared_options.h"
#include "ibmfair/base/types.h"
#include "ibmfair/io/extension.h"
#include "ibmfair/io/mesh_file.h"

namespace ibmfair::commands {

struct Report;

class Host {
 public:
  Host() = default;
  /// The messages and the progress go to the listener, which must outlive this object.
  explicit Host(Listener& listener) : console_(listener) {}
  virtual ~Host() = default;
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  Console& console() { return console_; }
  const Console& console() const { return console_; }

  /// Reads the mesh that an argument names; see read_mesh.
  virtual MeshFile read(const std::string& path, const ReadOptions& options) const;

  /// Throws BadOption if `write` would do so because of the format.
  virtual void require_writable(const MeshFile& source, const OutputOptions& output) const;

  /// Writes the source with its vertices at `X`; see write_mesh.
  virtual WriteReport write(const MeshFile& source, const Points& X,
                            const OutputOptions& output) const;

  /// Writes the source with its vertices at `X`, followed by the extension (io/extension.h).
  virtual WriteReport write(const MeshFile& source, const Points& X, const Extension& extension,
                            const OutputOptions& output) const;

  /// Writes a mesh that was not read from a file.
  virtual WriteReport write(const Mesh& mesh, const OutputOptions& output) const;

  /// Writes the report to each of the files in `options`, and to standard output if requested.
  virtual void deliver(const ReportOptions& options, bool overwrite, const Report& report) const;

  /// Whether the computation should end at the next step, and keep its result.
  virtual bool wants_end() const;

 private:
  Console console_;
};

}  // namespace ibmfair::commands
