// What the arguments of `smooth` come to on a mesh, or on a piece of one in several parts.
#pragma once

#include <cstdint>
#include <vector>

#include "commands/console.h"
#include "commands/smooth_arguments.h"
#include "commands/smooth_report.h"
#include "ibmfair/flow/mesh_parts.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair::commands {

/// Sets the options of the flow that other arguments name in words, but for those that are a value
/// for every vertex. Without --tangential, vertices slide within the surface unless that would drag
/// a texture over it.
void set_flow_options(const SmoothArguments& arguments, bool has_texture_coordinates,
                      const Console& console, FlowOptions& options);

/// Sets the total time and the bound on moves of `options`, and the cut-off among the figures.
/// Throws BadMesh where edges are too long or short for the flow's time to be a number.
void set_scale(const SmoothArguments& arguments, const Points& X, const Topology& topology,
               const MeshParts& parts, FlowOptions& options, SmoothFigures& figures);

/// #V, 1 for the vertices that do not move: those that --boundary holds, those of the list, and
/// those that `mask` or `weights` (#V, or empty) leave out.
std::vector<std::uint8_t> held_by(const SmoothArguments& arguments, const Topology& topology,
                                  const std::vector<Index>& listed,
                                  const std::vector<std::uint8_t>& mask,
                                  const Eigen::VectorXd& weights);

/// Notes how far vertices have moved.
void measure_moves(const Points& before, const Points& after, SmoothFigures& figures);

}  // namespace ibmfair::commands
