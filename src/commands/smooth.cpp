#include <algorithm>
#include <array>
#include <memory>
#include <optional>

#include <nlohmann/json.hpp>

#include "commands/command.h"
#include "commands/defect_warnings.h"
#include "commands/engine.h"
#include "commands/page/mesh_scene.h"
#include "commands/progress.h"
#include "commands/report/reading.h"
#include "commands/report/report_formats.h"
#include "commands/signals.h"
#include "commands/smooth_arguments.h"
#include "commands/smooth_input.h"
#include "commands/smooth_plan.h"
#include "commands/smooth_remarks.h"
#include "commands/smooth_report.h"
#include "commands/smooth_run.h"
#include "ibmfair/base/stopwatch.h"
#include "ibmfair/flow/willmore_flow.h"
#include "ibmfair/io/weld.h"
#include "ibmfair/page/scene_lines.h"

namespace ibmfair::commands {
namespace {

void check_formats(const SmoothArguments& arguments, const MeshFile& file, const Host& host) {
  for (const FlowStatus status : {FlowStatus::completed, FlowStatus::interrupted}) {
    const OutputOptions output = output_of(arguments, status);
    if (!output.path.empty()) {
      host.require_writable(file, output);
    }
  }
}

/// The mesh before and after smoothing, with the result.
struct Smoothing {
  MeshFile file;
  Topology topology;
  Points X;  // positions after smoothing
  SmoothResult result;

  const Points& before() const { return file.mesh().X; }
};

/// The positions of the vertices on open boundaries.
Points boundary_points(const Points& X, const Topology& topology) {
  std::vector<Index> on_boundary;
  for (Index v = 0; v < topology.vertex_count; ++v) {
    if (topology.kind[v] == VertexKind::boundary) {
      on_boundary.push_back(v);
    }
  }
  return X(on_boundary, Eigen::all);
}

Smoothing read_smoothing(const SmoothArguments& arguments, const Host& host, Progress& progress) {
  Smoothing s;
  progress.begin("read");
  {
    const Stopwatch watch(s.result.seconds_read);
    s.file = read_input(arguments.input, arguments.reading, host);
  }
  check_formats(arguments, s.file, host);
  progress.begin("connect");
  const Stopwatch watch(s.result.seconds_topology);
  s.topology = build_topology(s.before(), triangulate(s.file.mesh()).F);
  s.result.vertices = s.topology.vertex_count;
  s.result.triangles = s.topology.F.rows();
  s.result.has_rims = !s.topology.boundary_loops.empty();
  s.result.closed =
      s.topology.boundary_loops.empty() && s.topology.defects.non_manifold_edges.empty();
  s.result.defective = std::ranges::find(s.topology.defective, 1) != s.topology.defective.end();
  s.result.duplicates = std::ssize(s.topology.defects.duplicate);
  const Weld weld = find_coincident_vertices(boundary_points(s.before(), s.topology));
  s.result.boundary_vertices = std::ssize(weld.vertex);
  s.result.coincident = std::ssize(weld.vertex) - std::ssize(weld.first);
  s.X = s.before();
  return s;
}

void draw(const SmoothArguments& arguments, const Smoothing& s) {
  const std::string& laplacian = s.result.plan.flow.laplacian;
  const std::array<FieldState, 2> states{
      {{s.before(), s.topology, nullptr, laplacian}, {s.X, s.topology, &s.before(), laplacian}}};
  draw_picture(arguments.picture, arguments.output.write.overwrite, states, s.topology.F.rows());
}

/// The scene of the mesh before and after, with the border of the fixed vertices.
std::optional<Scene> smooth_scene(const SmoothArguments& arguments, const Smoothing& s,
                                  const std::vector<Warning>& warnings, const Console& console) {
  SceneSource source{arguments.input,
                     {{"before", &s.before(), &s.topology}, {"after", &s.X, &s.topology}},
                     s.result.plan.flow.laplacian};
  source.polygons = &s.file.mesh().faces;
  source.lines = fixed_lines(s.X, s.topology, s.result.plan.fixed);
  return mesh_scene(std::move(source), warnings, console);
}

/// Measures the mesh before and after. If no vertex was fixed, no rim faired and no outlier moved,
/// the energies of the whole mesh are known from the flow.
void measure(Smoothing& s) {
  SmoothResult& result = s.result;
  const Stopwatch watch(result.seconds_measure);
  const FlowOptions& options = result.plan.flow;
  const auto& fixed = result.plan.fixed;
  const bool known = options.steps > 0 && !result.plan.rims && result.plan.outliers.empty() &&
                     std::find(fixed.begin(), fixed.end(), 1) == fixed.end();
  const auto statistics = [&](const Points& X, double energy) {
    return known ? mesh_statistics(X, s.topology, energy) : mesh_statistics(X, s.topology, options);
  };
  result.before = statistics(s.before(), result.flow.energy_before);
  result.after = statistics(s.X, result.flow.energy_after);
  measure_moves(s.before(), s.X, result);
  if (options.steps > 0) {
    result.thickening = median_thickening(s.before(), s.X, s.topology, result.plan.wall_sample);
  }
}

ExitCode forecast(const SmoothArguments& arguments, const Smoothing& s, Report& report,
                  const Host& host) {
  const SmoothPlan& plan = s.result.plan;
  FlowForecast forecast;
  if (plan.flow.steps > 0) {
    forecast = forecast_flow(s.X, s.topology, plan.fixed, plan.flow);
  }
  print_forecast(arguments, s.result, forecast, host.console(), report);
  host.deliver(arguments.report, arguments.output.write.overwrite, report);
  return ExitCode::done;
}

/// Writes the smoothed mesh, and prints the results.
void write_and_print(const SmoothArguments& arguments, Smoothing& s, Report& report,
                     const Host& host, Progress& progress) {
  const Console& console = host.console();
  const OutputOptions output = output_of(arguments, s.result.flow.status);
  WriteReport written;
  progress.begin("write");
  {
    const Stopwatch watch(s.result.seconds_write);
    written = host.write(s.file, s.X, output);
  }
  draw(arguments, s);
  progress.end();
  report.figures["defects"] = defects_json(s.topology);
  print_result(arguments, s.result, output.path, written, "", console, report);
  report.scene = [&] { return smooth_scene(arguments, s, report.warnings, console); };
  host.deliver(arguments.report, output.write.overwrite, report);
}

ExitCode run_smooth(const SmoothArguments& arguments, const CLI::App& app, Host& host) {
  const Console& console = host.console();
  require_single_engine(arguments.engine);
  check_outputs(arguments);
  Progress progress(console);
  Smoothing s = read_smoothing(arguments, host, progress);
  warn_of_defects(s.topology, arguments.strict, console);
  Report report(app);
  report.warnings = defect_list(s.before(), s.topology);
  add_reading(s.file, report);
  s.result.plan = plan_smoothing(arguments, smooth_input(arguments, s.file, s.topology), progress);
  if (arguments.dry_run) {
    progress.end();
    return forecast(arguments, s, report, host);
  }
  std::optional<PostponedEnd> postponed;
  if (!arguments.checkpoint.empty() && s.result.plan.flow.steps > 0) {
    postponed.emplace();
  }
  s.result.flow = run_smoothing(
      s.result.plan, s.X, s.topology, MeshParts::one(), [&host] { return host.wants_end(); },
      progress);
  postponed.reset();
  progress.begin("measure");
  measure(s);
  write_and_print(arguments, s, report, host, progress);
  return exit_code_of(s.result);
}

}  // namespace

Runner declare_smooth(CLI::App& app) {
  auto arguments = std::make_shared<SmoothArguments>();
  add_smooth_arguments(app, *arguments);
  return [arguments, &app](Host& host) { return run_smooth(*arguments, app, host); };
}

}  // namespace ibmfair::commands
