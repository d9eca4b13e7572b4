#include "commands/smooth_input.h"

#include "commands/vertex_list.h"
#include "commands/vertex_values.h"

namespace ibmfair::commands {

SmoothInput smooth_input(const SmoothArguments& arguments, const MeshFile& file,
                         const Topology& topology) {
  SmoothInput input{.X = file.mesh().X, .topology = topology};
  input.textured = file.has_texture_coordinates();
  if (!arguments.weights.empty()) {
    input.weights = vertex_values(file, arguments.weights, 0, "--weights");
  }
  if (!arguments.h0.empty()) {
    input.h0 = vertex_values_or_number(file, arguments.h0, "--h0");
  }
  if (!arguments.fix_file.empty()) {
    input.listed = read_vertex_list("--fix", arguments.fix_file, topology.vertex_count);
  }
  if (!arguments.mask.empty()) {
    input.mask = file.vertex_mask(arguments.mask);
  }
  return input;
}

}  // namespace ibmfair::commands
