// What `smooth --denoise` stands for: the options that take noise of unknown strength off meshes of
// which nothing else is known. tools/denoise_table tries them on scans, parts and round shapes.
#pragma once

namespace CLI {
class App;
}
namespace ibmfair {
struct FlowOptions;
struct Topology;
}  // namespace ibmfair

namespace ibmfair::commands {

struct SmoothArguments;

/// Declares the flag. It must stand before the options that it sets, which it leaves as they are
/// where they are given, too.
void add_denoise_flag(CLI::App& app, SmoothArguments& arguments);

/// Whether the volume is kept: where the mesh has one, and moves are not bounded, which would keep
/// it from being held exactly.
bool keeps_volume_of(const Topology& topology, const SmoothArguments& arguments);

/// The options of a flow in place of these, but for the angle, where there are creases.
FlowOptions crease_options(const SmoothArguments& arguments, FlowOptions options);

}  // namespace ibmfair::commands
