#include <algorithm>
#include <array>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/command.h"
#include "commands/defect_warnings.h"
#include "commands/denoise_defaults.h"
#include "commands/engine.h"
#include "commands/page/mesh_scene.h"
#include "commands/progress.h"
#include "commands/report/report_formats.h"
#include "commands/smooth_arguments.h"
#include "commands/smooth_report.h"
#include "commands/smooth_setup.h"
#include "commands/vertex_list.h"
#include "commands/vertex_values.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/base/stopwatch.h"
#include "ibmfair/flow/willmore_flow.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/page/scene_lines.h"

namespace ibmfair::commands {
namespace {

std::vector<std::uint8_t> fixed(const SmoothArguments& arguments, const MeshFile& file,
                                const Topology& topology, const Eigen::VectorXd& weights) {
  std::vector<Index> listed;
  if (!arguments.fix_file.empty()) {
    listed = read_vertex_list(arguments.fix_file, topology.vertex_count);
  }
  std::vector<std::uint8_t> mask;
  if (!arguments.mask.empty()) {
    mask = file.vertex_mask(arguments.mask);
  }
  return held_by(arguments, topology, listed, mask, weights);
}

void draw(const SmoothArguments& arguments, const Topology& topology, const Points& before,
          const Points& after) {
  const std::array<FieldState, 2> states{{{before, topology, nullptr, arguments.flow.laplacian},
                                          {after, topology, &before, arguments.flow.laplacian}}};
  draw_picture(arguments.picture, arguments.output.write.overwrite, states, topology.F.rows());
}

void check_formats(const SmoothArguments& arguments, const MeshFile& file) {
  require_writable_format(file, arguments.output.path, arguments.output.write);
  if (!arguments.checkpoint.empty()) {
    const OutputOptions checkpoint = checkpoint_of(arguments);
    require_writable_format(file, checkpoint.path, checkpoint.write);
  }
}

/// The mesh before and after smoothing, with the results.
struct Smoothing {
  MeshFile file;
  Topology topology;
  Points X;  // positions after smoothing
  std::vector<std::uint8_t> fixed;
  SmoothFigures figures;

  const Points& before() const { return file.mesh().X; }
};

Smoothing read_smoothing(const SmoothArguments& arguments, const Console& console,
                         Progress& progress) {
  Smoothing s;
  progress.begin("read");
  {
    const Stopwatch watch(s.figures.seconds_read);
    s.file = read_input(arguments.input, arguments.reading, console);
  }
  check_formats(arguments, s.file);
  progress.begin("connect");
  const Stopwatch watch(s.figures.seconds_topology);
  s.topology = build_topology(s.before(), triangulate(s.file.mesh()).F);
  s.figures.vertices = s.topology.vertex_count;
  s.figures.triangles = s.topology.F.rows();
  s.figures.closed = s.topology.boundary_loops.empty();
  s.X = s.before();
  return s;
}

ExitCode forecast(const SmoothArguments& arguments, Smoothing& s, Report& report,
                  Console& console) {
  FlowOptions options = arguments.flow;
  FlowForecast forecast;
  if (options.steps > 0) {
    set_scale(arguments, s.before(), s.topology, MeshParts::one(), options, s.figures);
    forecast = forecast_flow(s.X, s.topology, s.fixed, options);
  }
  report.figures["input"] = arguments.input;
  add_cutoff_choice(s.figures, report);
  report.figures["forecast"] = forecast_json(forecast);
  deliver_report(arguments.report, arguments.output.write.overwrite, report);
  console.note(fmt::format("{}: {} of {} vertices would move in {} steps", arguments.input,
                           forecast.unknowns, s.topology.vertex_count, options.steps),
               (s.figures.choice ? cutoff_lines(s.figures, true) : "") + forecast_table(forecast));
  return ExitCode::done;
}

/// The scene of the mesh before and after, with the border of the fixed vertices.
std::optional<Scene> smooth_scene(const SmoothArguments& arguments, const Smoothing& s,
                                  const std::vector<Warning>& warnings, const Console& console) {
  SceneSource source{arguments.input,
                     {{"before", &s.before(), &s.topology}, {"after", &s.X, &s.topology}},
                     arguments.flow.laplacian};
  source.polygons = &s.file.mesh().faces;
  if (!s.fixed.empty()) {
    source.lines = held_lines(s.X, s.topology, s.fixed);
  }
  return mesh_scene(std::move(source), warnings, console);
}

/// Writes the smoothed mesh, and prints the results.
void write_and_tell(const SmoothArguments& arguments, const OutputOptions& output, Smoothing& s,
                    Report& report, const Console& console, Progress& progress) {
  WriteReport written;
  progress.begin("write");
  {
    const Stopwatch watch(s.figures.seconds_write);
    written = write_mesh(s.file, s.X, output.path, output.write);
  }
  draw(arguments, s.topology, s.before(), s.X);
  progress.end();
  report.figures["defects"] = defects_json(s.topology);
  print_smoothing(arguments, s.figures, output.path, written, "", console, report);
}

/// The options of the flow, completed from the mesh and from other options.
FlowOptions flow_options(const SmoothArguments& arguments, const Smoothing& s) {
  FlowOptions options = arguments.flow;
  set_flow_options(arguments, options);
  options.keep_volume |= keeps_volume_of(s.topology, arguments);
  if (!arguments.weights.empty()) {
    options.cutoff_factor = vertex_values(s.file, arguments.weights, 0, "--weights");
  }
  if (!arguments.h0.empty()) {
    options.spontaneous_curvature = vertex_values_or_number(s.file, arguments.h0, "--h0");
  }
  return options;
}

/// Computes the figures of the mesh before and after. If no vertex was fixed, the energies of the
/// whole mesh are known from the flow.
void measure(Smoothing& s, const FlowOptions& options) {
  const Stopwatch watch(s.figures.seconds_measure);
  const bool known =
      options.steps > 0 && std::find(s.fixed.begin(), s.fixed.end(), 1) == s.fixed.end();
  const auto figures = [&](const Points& X, double energy) {
    return known ? mesh_figures(X, s.topology, energy) : mesh_figures(X, s.topology, options);
  };
  s.figures.before = figures(s.before(), s.figures.flow.energy_before);
  s.figures.after = figures(s.X, s.figures.flow.energy_after);
  measure_moves(s.before(), s.X, s.figures);
}

ExitCode run_smooth(SmoothArguments arguments, const CLI::App& app, Console& console) {
  require_single_engine(arguments.engine);
  check_outputs(arguments);
  Progress progress(console);
  Smoothing s = read_smoothing(arguments, console, progress);
  warn_of_defects(s.topology, arguments.strict, console);
  Report report(app);
  report.warnings = defect_list(s.before(), s.topology);
  arguments.textured = s.file.has_texture_coordinates();
  arguments.flow = flow_options(arguments, s);
  const FlowOptions& options = arguments.flow;
  s.figures.mean_edge_length = mean_edge_length(s.before(), s.topology.E);
  if (options.steps > 0) {
    s.fixed = fixed(arguments, s.file, s.topology, options.cutoff_factor);
    resolve_cutoff(arguments, s.before(), s.topology, s.fixed, s.figures, progress);
  }
  project_directions(arguments, s.before(), s.topology, s.fixed, MeshParts::one(), s.figures,
                     progress);
  if (arguments.dry_run) {
    progress.end();
    return forecast(arguments, s, report, console);
  }
  if (options.steps > 0) {
    run_smoothing(arguments, s.X, s.topology, s.fixed, MeshParts::one(), s.figures, progress);
  }
  progress.begin("measure");
  measure(s, options);

  const bool interrupted = s.figures.flow.status == FlowStatus::interrupted;
  const OutputOptions output = interrupted ? checkpoint_of(arguments) : arguments.output;
  write_and_tell(arguments, output, s, report, console, progress);
  report.scene = [&] { return smooth_scene(arguments, s, report.warnings, console); };
  deliver_report(arguments.report, output.write.overwrite, report);
  return exit_code_of(s.figures);
}

}  // namespace

Runner declare_smooth(CLI::App& app) {
  auto arguments = std::make_shared<SmoothArguments>();
  add_smooth_arguments(app, *arguments);
  return [arguments, &app](Console& console) { return run_smooth(*arguments, app, console); };
}

}  // namespace ibmfair::commands
