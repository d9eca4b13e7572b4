// What `smooth --denoise` is shorthand for: the options that remove noise of unknown strength from
// meshes of which nothing else is known. tools/denoise_table tries them on scans, parts and round
// shapes.
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

/// Declares the flag. It must be declared before the options that it sets. Options that are given
/// on the command line, too, keep what is given.
void add_denoise_flag(CLI::App& app, SmoothArguments& arguments);

/// Lines for the help: the options that the flag is shorthand for.
std::string denoising_text();

/// Whether the volume is kept: where the mesh has one, and moves are not bounded, which would keep
/// it from being held exactly.
bool keeps_volume_of(const Topology& topology, const SmoothArguments& arguments);

/// The options of a flow in place of these, but for the angle, where there are creases.
FlowOptions crease_options(const SmoothArguments& arguments, FlowOptions options);

}  // namespace ibmfair::commands
