#include "petsc_engine/mesh_source.h"

#include <filesystem>

#include <fmt/format.h>

#include "petsc_engine/ply_source.h"
#include "petsc_engine/whole_source.h"

namespace ibmfair::petsc {
namespace {

/// Whether file names and options allow that all ranks read and write the file in pieces.
bool may_be_shared(const std::string& input, const std::string& output,
                   const commands::InputOptions& options) {
  std::error_code error;
  const std::filesystem::file_status target = std::filesystem::status(output, error);
  const bool replaceable =
      !std::filesystem::exists(target) || std::filesystem::is_regular_file(target);
  return input != "-" && std::filesystem::is_regular_file(input, error) && output != "-" &&
         replaceable && output.ends_with(".ply") && !options.read.weld &&
         (options.read.format.empty() || options.read.format == "ply");
}

}  // namespace

std::unique_ptr<MeshSource> open_source(const Communicator& comm, const std::string& input,
                                        const std::string& output,
                                        const commands::InputOptions& options,
                                        const commands::Host& host) {
  if (!comm.any(!may_be_shared(input, output, options))) {
    if (auto source = PlySource::open(comm, input)) {
      return source;
    }
  }
  if (comm.size() > 1) {
    host.console().note(
        fmt::format("{} -> {}: not from one binary PLY file of triangles to another, so "
                    "the first rank reads and writes it whole",
                    input, output));
  }
  return std::make_unique<WholeSource>(comm, input, options, host);
}

}  // namespace ibmfair::petsc
