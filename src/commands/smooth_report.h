// The report of a run of `smooth`: a table for people, JSON for programs.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "commands/console.h"
#include "commands/mesh_statistics.h"
#include "commands/report/report.h"
#include "commands/smooth_arguments.h"
#include "commands/smooth_plan.h"
#include "ibmfair/flow/willmore_flow.h"
#include "ibmfair/io/mesh_file.h"

namespace ibmfair::commands {

/// The plan of a run, and what came of it.
struct SmoothResult {
  SmoothPlan plan;
  FlowReport flow;
  MeshStatistics before, after;
  double largest_move = 0, rms_move = 0;  ///< over all vertices, length
  double thickening = 1;  ///< median ratio of the thickness of walls after to that before
  std::int64_t vertices = 0, triangles = 0;
  std::int64_t boundary_vertices = 0;  ///< on open boundaries
  std::int64_t coincident = 0;         ///< of these, so many lie exactly on others
  std::int64_t duplicates = 0;         ///< triangles with the same vertices as another
  bool closed = true;                  ///< every edge lies between two triangles
  bool has_rims = false;               ///< open boundaries
  bool defective = false;  ///< whether vertices are fixed because the mesh has defects there
  double seconds_read = 0, seconds_topology = 0, seconds_measure = 0, seconds_write = 0;
};

/// Throws as check_reports does if an output file that the run writes cannot be written. A dry run
/// writes only reports.
void check_outputs(const SmoothArguments& arguments);

/// The file to which the mesh is written: OUT, or --checkpoint after an interrupted flow.
OutputOptions output_of(const SmoothArguments& arguments, FlowStatus status);

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

}  // namespace ibmfair::commands
