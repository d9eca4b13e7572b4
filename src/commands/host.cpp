#include "commands/host.h"

#include "commands/report/report_formats.h"
#include "commands/signals.h"

namespace ibmfair::commands {

MeshFile Host::read(const std::string& path, const ReadOptions& options) const {
  return read_mesh(path, options);
}

void Host::require_writable(const MeshFile& source, const OutputOptions& output) const {
  require_writable_format(source, output.path, output.write);
}

WriteReport Host::write(const MeshFile& source, const Points& X,
                        const OutputOptions& output) const {
  return write_mesh(source, X, output.path, output.write);
}

WriteReport Host::write(const MeshFile& source, const Points& X, const Extension& extension,
                        const OutputOptions& output) const {
  return write_mesh(source, X, extension, output.path, output.write);
}

WriteReport Host::write(const Mesh& mesh, const OutputOptions& output) const {
  return write_mesh(mesh, output.path, output.write);
}

void Host::deliver(const ReportOptions& options, bool overwrite, const Report& report) const {
  deliver_report(options, overwrite, report);
}

bool Host::wants_end() const {
  return PostponedEnd::signal_number() != 0;
}

}  // namespace ibmfair::commands
