// The report of a run of `smooth`: a table for people, JSON for programs.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "commands/console.h"
#include "commands/exit_code.h"
#include "commands/report/report.h"
#include "commands/smooth_arguments.h"
#include "commands/smooth_plan.h"
#include "ibmfair/flow/willmore_flow.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair::commands {

/// What is measured of one state of a mesh.
struct MeshStatistics {
  double energy = 0;  ///< E_b of the whole mesh under the run's Laplacian
  double area = 0, volume = 0;
  double smallest_angle = 0;  ///< degrees
  std::int64_t folds = 0;     ///< hinges sharper than fold_angle
};

/// The plan of a run, and what came of it.
struct SmoothResult {
  SmoothPlan plan;
  FlowReport flow;
  MeshStatistics before, after;
  double largest_move = 0, rms_move = 0;  ///< over all vertices, length
  std::int64_t vertices = 0, triangles = 0;
  bool closed = true;
  double seconds_read = 0, seconds_topology = 0, seconds_measure = 0, seconds_write = 0;
};

/// Throws as check_reports does if an output file that the arguments name cannot be written.
void check_outputs(const SmoothArguments& arguments);

/// The file to which the mesh is written: OUT, or --checkpoint after an interrupted flow.
OutputOptions output_of(const SmoothArguments& arguments, FlowStatus status);

/// E_b, area, volume and quality of `X`.
MeshStatistics mesh_statistics(const Points& X, const Topology& topology,
                               const FlowOptions& options);

/// Like above, if E_b is already known: to create the energy of a mesh takes longer than everything
/// else.
MeshStatistics mesh_statistics(const Points& X, const Topology& topology, double energy);

/// The statistics of `X` as a JSON object, with the numbers of vertices, triangles and boundary
/// loops, for runs that change the connectivity.
nlohmann::ordered_json mesh_state_json(const Points& X, const Topology& topology,
                                       const FlowOptions& options);

/// Stores the largest and the root-mean-square move of the vertices in the result.
void measure_moves(const Points& before, const Points& after, SmoothResult& result);

/// Prints the forecast of time and memory of a run, and adds it to the report.
void print_forecast(const SmoothArguments& arguments, const SmoothResult& result,
                    const FlowForecast& forecast, const Console& console, Report& report);

/// Prints the results and the name of the written file `output`, and adds them to the report. `by`
/// is a text that follows the number of moved vertices and says which processes did the work; it is
/// empty for this process alone.
void print_result(const SmoothArguments& arguments, const SmoothResult& result,
                  const std::string& output, const WriteReport& written, std::string_view by,
                  const Console& console, Report& report);

ExitCode exit_code_of(const SmoothResult& result);

}  // namespace ibmfair::commands
