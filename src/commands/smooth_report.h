// What `smooth` tells of a run: as a table for people, as JSON for programs.
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "commands/exit_code.h"
#include "commands/report/report.h"
#include "commands/smooth_arguments.h"
#include "ibmfair/flow/cutoff_choice.h"
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

/// Creases that are kept as that leaves less error.
struct FoundCreases {
  double sharp_angle = 0;  ///< radians
  CutoffChoice without;    ///< keeping any
};

struct SmoothFigures {
  MeshFigures before, after;
  double largest_move = 0, rms_move = 0;  ///< of all vertices, length
  double mean_edge_length = 0;            ///< before
  double cutoff = 0;                      ///< length that the total time corresponds to
  std::optional<CutoffChoice> choice;     ///< of this length, with --cutoff auto
  std::optional<FoundCreases> creases;    ///< with --denoise
  double diagonal = 0;                    ///< of the bounding box, before
  double total_time = 0;                  ///< that the flow was to run for, in its unit
  std::int64_t vertices = 0, triangles = 0;
  bool closed = true;
  double seconds_read = 0, seconds_topology = 0, seconds_choice = 0, seconds_directions = 0;
  double seconds_measure = 0, seconds_write = 0;
  FlowReport flow;
};

/// E_b, area, volume and quality of `X`.
MeshFigures mesh_figures(const Points& X, const Topology& topology, const FlowOptions& options);

/// As above, where E_b is known: the energy takes longer to bind to a mesh than all the rest.
MeshFigures mesh_figures(const Points& X, const Topology& topology, double energy);

/// They as an object, with the counts of a mesh whose connectivity a run may change.
nlohmann::ordered_json mesh_state_json(const Points& X, const Topology& topology,
                                       const FlowOptions& options);

/// Aligned lines, ending in a line feed: figures before and after, and what the run took. With
/// `detailed`, the energy after each step as a curve, too, and all stages.
std::string smooth_table(const SmoothFigures& figures, bool detailed);

/// The cut-off, and where it was chosen the noise by which; with `detailed`, all that was tried.
std::string cutoff_lines(const SmoothFigures& figures, bool detailed);

/// What is to be said about the end of the flow, whose state is in the file `output`; empty: it
/// went as it should.
std::string remark_on(const SmoothFigures& figures, const std::string& output,
                      const SmoothArguments& arguments);

ExitCode exit_code_of(const SmoothFigures& figures);

/// What a run would take, as aligned lines and as JSON.
std::string forecast_table(const FlowForecast& forecast);
nlohmann::ordered_json forecast_json(const FlowForecast& forecast);

/// What the choice of the cut-off was by, if there was one.
void add_cutoff_choice(const SmoothFigures& figures, Report& report);

/// The fields of the report that the run fills, and its steps as a table.
void add_smooth_figures(const SmoothFigures& figures, const FlowOptions& options, Report& report);

}  // namespace ibmfair::commands
