// The options that `smooth --denoise` is shorthand for. They remove noise of unknown strength from
// arbitrary meshes. tools/denoise_table tests them on scans, mechanical parts and round shapes.
#pragma once

#include <string>

namespace CLI {
class App;
}
namespace ibmfair {
struct FlowOptions;
struct Topology;
}  // namespace ibmfair

namespace ibmfair::commands {

struct SmoothArguments;

/// Declares --denoise, which must be declared before the options that it sets. An option that is
/// also given on the command line keeps the given value.
void add_denoise_flag(CLI::App& app, SmoothArguments& arguments);

/// Lines for the help: the options that the flag is shorthand for.
std::string denoising_text();

/// Whether --denoise keeps the volume: if the mesh is closed and orientable and --max-move is not
/// given, because with bounded moves the volume cannot be kept exactly.
bool keeps_volume_of(const Topology& topology, const SmoothArguments& arguments);

/// The options of the flow that replace `options` if the mesh has creases, except for the angle.
FlowOptions crease_options(const SmoothArguments& arguments, FlowOptions options);

}  // namespace ibmfair::commands
