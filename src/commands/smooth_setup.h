// What `smooth` does alike on a mesh and on a piece of one in several parts.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "commands/console.h"
#include "commands/progress.h"
#include "commands/smooth_arguments.h"
#include "commands/smooth_report.h"
#include "ibmfair/flow/mesh_parts.h"
#include "ibmfair/io/mesh_file.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair::commands {

/// Throws where a file that the arguments name could not be written.
void check_outputs(const SmoothArguments& arguments);

/// Where the state goes that an interrupted run has reached.
OutputOptions checkpoint_of(const SmoothArguments& arguments);

/// Sets the options of the flow that other arguments name in words, but for those that are a value
/// for every vertex or triangle.
void set_flow_options(const SmoothArguments& arguments, FlowOptions& options);

/// Those of them that --tangential names. Without it, vertices slide within the surface unless that
/// would drag a texture over it.
void set_relaxation(const SmoothArguments& arguments, FlowOptions& options);

/// Sets the total time and the bound on moves of `options`, and the cut-off among the figures.
/// Throws BadMesh where edges are too long or short for the flow's time to be a number.
void set_scale(const SmoothArguments& arguments, const Points& X, const Topology& topology,
               const MeshParts& parts, FlowOptions& options, SmoothFigures& figures);

/// With --cutoff auto, chooses the cut-off where vertices move, which becomes that of the
/// arguments, and whether creases are kept; notes why among the figures. Throws as set_scale and
/// choose_cutoff.
void resolve_cutoff(SmoothArguments& arguments, const Points& X, const Topology& topology,
                    const std::vector<std::uint8_t>& held, SmoothFigures& figures,
                    Progress& progress);

/// With --anisotropy, lays the direction onto the surface as the same flow leaves it without one,
/// and from there back onto the mesh: triangles that noise has turned and stretched would each
/// bring a direction of their own. With --dry-run, onto the mesh as it is. Throws as set_scale,
/// willmore_flow and material_directions.
void lay_directions(SmoothArguments& arguments, const Points& X, const Topology& topology,
                    const std::vector<std::uint8_t>& held, const MeshParts& parts,
                    SmoothFigures& figures, Progress& progress);

/// #V, 1 for the vertices that do not move: those that --boundary holds, those of the list, and
/// those that `mask` or `weights` (#V, or empty) leave out.
std::vector<std::uint8_t> held_by(const SmoothArguments& arguments, const Topology& topology,
                                  const std::vector<Index>& listed,
                                  const std::vector<std::uint8_t>& mask,
                                  const Eigen::VectorXd& weights);

/// Moves X by `arguments.flow` and notes what comes of it. With --checkpoint, a request to end is
/// heeded between two steps. Throws as set_scale and willmore_flow.
void run_flow(const SmoothArguments& arguments, Points& X, const Topology& topology,
              const std::vector<std::uint8_t>& held, const MeshParts& parts, SmoothFigures& figures,
              Progress& progress);

/// Notes how far vertices have moved.
void measure_moves(const Points& before, const Points& after, SmoothFigures& figures);

/// Says what was done and written to `output`, and notes it in the report. `by` tells by whom,
/// after the count of moved vertices; empty: by this process.
void tell_of_smoothing(const SmoothArguments& arguments, const SmoothFigures& figures,
                       const std::string& output, const WriteReport& written, std::string_view by,
                       const Console& console, Report& report);

}  // namespace ibmfair::commands
