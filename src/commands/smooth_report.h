// The report of a run of `smooth`: a table for people, JSON for programs.
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "commands/exit_code.h"
#include "commands/report/report.h"
#include "commands/smooth_arguments.h"
#include "ibmfair/flow/settings/cutoff_choice.h"
#include "ibmfair/flow/willmore_flow.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair::commands {

/// Figures of one state of the mesh.
struct MeshFigures {
  double energy = 0;  ///< E_b of the whole mesh under the run's Laplacian
  double area = 0, volume = 0;
  double smallest_angle = 0;  ///< degrees
  std::int64_t folds = 0;     ///< hinges sharper than fold_angle
};

/// Creases that are kept because this reduces the expected error.
struct FoundCreases {
  double sharp_angle = 0;  ///< radians
  CutoffChoice without;    ///< the best cut-off if no creases are kept
};

struct SmoothFigures {
  MeshFigures before, after;
  double largest_move = 0, rms_move = 0;  ///< over all vertices, length
  double mean_edge_length = 0;            ///< before the flow
  double cutoff = 0;                      ///< length that corresponds to the total time
  std::optional<CutoffChoice> choice;     ///< how `cutoff` was chosen, with --cutoff auto
  std::optional<FoundCreases> creases;    ///< with --denoise
  double diagonal = 0;                    ///< of the bounding box, before the flow
  double total_time = 0;                  ///< requested time of the flow, in its unit
  std::int64_t vertices = 0, triangles = 0;
  bool closed = true;
  double seconds_read = 0, seconds_topology = 0, seconds_choice = 0, seconds_directions = 0;
  double seconds_measure = 0, seconds_write = 0;
  FlowReport flow;
};

/// E_b, area, volume and quality of `X`.
MeshFigures mesh_figures(const Points& X, const Topology& topology, const FlowOptions& options);

/// Like above, if E_b is already known: to create the energy of a mesh takes longer than everything
/// else.
MeshFigures mesh_figures(const Points& X, const Topology& topology, double energy);

/// The figures of `X` as a JSON object, with the numbers of vertices, triangles and boundary loops,
/// for runs that change the connectivity.
nlohmann::ordered_json mesh_state_json(const Points& X, const Topology& topology,
                                       const FlowOptions& options);

/// A table of aligned lines, ending in a line feed: the figures before and after, and the effort of
/// the run. If `detailed`, also a curve of the energy after each step, and the times of all stages.
std::string smooth_table(const SmoothFigures& figures, bool detailed);

/// Lines with the cut-off and, if it was chosen automatically, the noise that it was chosen from.
/// If `detailed`, also all cut-offs that were tried.
std::string cutoff_lines(const SmoothFigures& figures, bool detailed);

/// A remark if the flow did not end as requested; else empty. The final state of the flow is in the
/// file `output`.
std::string remark_on(const SmoothFigures& figures, const std::string& output,
                      const SmoothArguments& arguments);

ExitCode exit_code_of(const SmoothFigures& figures);

/// The forecast of time and memory of a run, as aligned lines and as JSON.
std::string forecast_table(const FlowForecast& forecast);
nlohmann::ordered_json forecast_json(const FlowForecast& forecast);

/// Adds to the report how the cut-off was chosen, if it was chosen automatically.
void add_cutoff_choice(const SmoothFigures& figures, Report& report);

/// Adds to the report the figures of the run, and its steps as a table.
void add_smooth_figures(const SmoothFigures& figures, const FlowOptions& options, Report& report);

}  // namespace ibmfair::commands
