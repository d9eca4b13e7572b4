// The parts of `smooth` that are the same for a whole mesh and for one piece of a distributed mesh.
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

/// Throws as check_reports does if an output file that the arguments name cannot be written.
void check_outputs(const SmoothArguments& arguments);

/// The file to which the state of an interrupted run is written.
OutputOptions checkpoint_of(const SmoothArguments& arguments);

/// Sets the options of the flow that the arguments give as names, angles and flags, but not the
/// options with one value per vertex or triangle.
void set_flow_options(const SmoothArguments& arguments, FlowOptions& options);

/// Sets the options of the flow for --tangential. Without --tangential, vertices slide within the
/// surface, except on a textured mesh, where the texture would shift.
void set_relaxation(const SmoothArguments& arguments, FlowOptions& options);

/// Sets the total time and the bound on moves in `options`, and the cut-off in `figures`. Throws
/// BadMesh if the edges are so long or short that the time of the flow overflows or underflows.
void set_scale(const SmoothArguments& arguments, const Points& X, const Topology& topology,
               const MeshParts& parts, FlowOptions& options, SmoothFigures& figures);

/// With --cutoff auto, and if any vertex can move, chooses the cut-off and whether creases are
/// kept. Stores the choice in the arguments, and its reasons in the figures. Throws like set_scale
/// and choose_cutoff.
void resolve_cutoff(SmoothArguments& arguments, const Points& X, const Topology& topology,
                    const std::vector<std::uint8_t>& fixed, SmoothFigures& figures,
                    Progress& progress);

/// With --anisotropy, computes the material direction of every triangle. The direction is projected
/// onto the surface that the same flow without anisotropy produces, and carried back to the mesh
/// with its triangles. The triangles of the noisy mesh, turned and stretched by the noise, would
/// each give a different direction. With --dry-run or without steps, the direction is projected
/// onto the mesh as it is. Throws like set_scale, willmore_flow and material_directions.
void project_directions(SmoothArguments& arguments, const Points& X, const Topology& topology,
                        const std::vector<std::uint8_t>& fixed, const MeshParts& parts,
                        SmoothFigures& figures, Progress& progress);

/// #V, 1 for fixed vertices: vertices that --boundary fixes, vertices of the list, and vertices for
/// which `mask` or `weights` (#V, or empty) is 0.
std::vector<std::uint8_t> held_by(const SmoothArguments& arguments, const Topology& topology,
                                  const std::vector<Index>& listed,
                                  const std::vector<std::uint8_t>& mask,
                                  const Eigen::VectorXd& weights);

/// Moves X by the flow with the options `arguments.flow`, and stores the flow's report in the
/// figures. With --checkpoint, a request to end stops the flow between two steps. Throws like
/// set_scale and willmore_flow.
void run_smoothing(const SmoothArguments& arguments, Points& X, const Topology& topology,
                   const std::vector<std::uint8_t>& fixed, const MeshParts& parts,
                   SmoothFigures& figures, Progress& progress);

/// Stores the largest and the root-mean-square move of the vertices in the figures.
void measure_moves(const Points& before, const Points& after, SmoothFigures& figures);

/// Prints the results and the name of the written file `output`, and adds them to the report. `by`
/// is a text that follows the number of moved vertices and says which processes did the work; it is
/// empty for this process alone.
void print_smoothing(const SmoothArguments& arguments, const SmoothFigures& figures,
                     const std::string& output, const WriteReport& written, std::string_view by,
                     const Console& console, Report& report);

}  // namespace ibmfair::commands
