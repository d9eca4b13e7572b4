// The options that `smooth --denoise` is shorthand for. They remove noise of unknown strength from
// arbitrary meshes. tools/denoise_table tests them on scans, mechanical parts and round shapes.
#pragma once

#include <string>

namespace CLI {
class App;
}
namespace ibmfair {
struct FlowOptions;
}  // namespace ibmfair

namespace ibmfair::commands {

struct SmoothArguments;

/// Declares --denoise, which must be declared before the options that it sets. An option that is
/// also given on the command line keeps the given value.
void add_denoise_flag(CLI::App& app, SmoothArguments& arguments);

/// Lines for the help: the options that the flag is shorthand for.
std::string denoising_text();

/// Sets the options of the flow that have other values if the mesh has creases, except for the
/// angle.
void keep_creases(FlowOptions& options);

/// Sets the options of the flow that have other values if the linear elements leave less error than
/// the umbrella Laplacian, as they do on most round shapes.
void suit_round_shapes(FlowOptions& options);

}  // namespace ibmfair::commands
