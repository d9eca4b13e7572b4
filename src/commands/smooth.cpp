#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/command.h"
#include "commands/defect_warnings.h"
#include "commands/page/mesh_scene.h"
#include "commands/progress.h"
#include "commands/report/report_formats.h"
#include "commands/signals.h"
#include "commands/smooth_arguments.h"
#include "commands/smooth_report.h"
#include "commands/vertex_list.h"
#include "commands/vertex_values.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/base/stopwatch.h"
#include "ibmfair/flow/held_vertices.h"
#include "ibmfair/flow/time_scale.h"
#include "ibmfair/flow/willmore_flow.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/page/scene_lines.h"

namespace ibmfair::commands {
namespace {

/// Without --cutoff and --time-step, this many steps make this cut-off, and more smooth more.
constexpr int default_steps = 16;
constexpr double default_cutoff_edges = 8;

/// The total time in the flow's unit. Its step is --time-step, or what spreads --cutoff evenly.
double total_time(const SmoothArguments& arguments, const Points& X, const Topology& topology) {
  if (arguments.time_step) {
    return *arguments.time_step * arguments.flow.steps;
  }
  const Length cutoff = arguments.cutoff.value_or(Length{default_cutoff_edges});
  const double parts = arguments.cutoff ? arguments.flow.steps : default_steps;
  const double time = time_for_cutoff(cutoff.on(X, topology));
  const double total =
      time_in_flow_units(time, X, topology, arguments.flow) / parts * arguments.flow.steps;
  if (!(total > 0 && std::isfinite(total))) {
    throw BadMesh(fmt::format("edges of mean length {} are too {} to smooth",
                              mean_edge_length(X, topology.E), total > 0 ? "long" : "short"));
  }
  return total;
}

/// The cut-off that the total time corresponds to: the inverse of time_for_cutoff.
double cutoff_of(double time, const Points& X, const Topology& topology,
                 const FlowOptions& options) {
  const double unit = time_in_flow_units(1, X, topology, options);
  return std::pow(time / unit, 0.25) / std::pow(time_for_cutoff(1), 0.25);
}

BoundaryCondition boundary_condition(const std::string& name) {
  return name == "fixed"      ? BoundaryCondition::fixed
         : name == "position" ? BoundaryCondition::position
                              : BoundaryCondition::free;
}

std::vector<std::uint8_t> held(const SmoothArguments& arguments, const MeshFile& file,
                               const Topology& topology, const Eigen::VectorXd& weights) {
  auto result = held_vertices(topology, boundary_condition(arguments.boundary));
  if (!arguments.fix_file.empty()) {
    for (const Index v : read_vertex_list(arguments.fix_file, topology.vertex_count)) {
      result[v] = 1;
    }
  }
  if (!arguments.mask.empty()) {
    const std::vector<std::uint8_t> chosen = file.vertex_mask(arguments.mask);
    for (std::size_t v = 0; v < chosen.size(); ++v) {
      result[v] |= chosen[v] ? 0 : 1;
    }
  }
  for (Eigen::Index v = 0; v < weights.size(); ++v) {
    result[v] |= weights[v] > 0 ? 0 : 1;
  }
  return result;
}

/// Sliding vertices within the surface would drag a texture over it.
bool relaxes(const SmoothArguments& arguments, const MeshFile& file, const Console& console) {
  if (arguments.tangential.empty() && file.has_texture_coordinates() && !arguments.plain) {
    console.note("the mesh has texture coordinates: no tangential relaxation (--tangential relax)");
    return false;
  }
  return arguments.tangential != "none";
}

void measure_moves(const Points& before, const Points& after, SmoothFigures& figures) {
  if (before.rows() > 0) {
    const Eigen::VectorXd squared = (after - before).rowwise().squaredNorm();
    figures.largest_move = std::sqrt(squared.maxCoeff());
    figures.rms_move = std::sqrt(squared.mean());
  }
}

/// Sets what depends on the mesh.
void resolve(const SmoothArguments& arguments, const Points& X, const Topology& topology,
             FlowOptions& options, SmoothFigures& figures) {
  options.total_time = total_time(arguments, X, topology);
  figures.cutoff = cutoff_of(options.total_time, X, topology, options);
  if (arguments.max_move) {
    options.max_move = arguments.max_move->on(X, topology);
  }
}

void draw(const SmoothArguments& arguments, const Topology& topology, const Points& before,
          const Points& after) {
  const std::array<FieldState, 2> states{{{before, topology, nullptr, arguments.flow.laplacian},
                                          {after, topology, &before, arguments.flow.laplacian}}};
  draw_picture(arguments.picture, arguments.output.write.overwrite, states, topology.F.rows());
}

/// Where the state goes that an interrupted run has reached.
OutputOptions checkpoint_of(const SmoothArguments& arguments) {
  OutputOptions checkpoint = arguments.output;
  checkpoint.path = arguments.checkpoint;
  checkpoint.write.format.clear();
  return checkpoint;
}

void check_outputs(const SmoothArguments& arguments) {
  check_reports(arguments.report,
                {{"", arguments.output.path},
                 {"--picture", arguments.picture.path},
                 {"--checkpoint", arguments.checkpoint}},
                arguments.output.write.overwrite);
}

void check_formats(const SmoothArguments& arguments, const MeshFile& file) {
  require_writable_format(file, arguments.output.path, arguments.output.write);
  if (!arguments.checkpoint.empty()) {
    const OutputOptions checkpoint = checkpoint_of(arguments);
    require_writable_format(file, checkpoint.path, checkpoint.write);
  }
}

/// The mesh and what becomes of it.
struct Smoothing {
  MeshFile file;
  Topology topology;
  Points X;  // after
  std::vector<std::uint8_t> held;
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
  s.X = s.before();
  return s;
}

void run_flow(const SmoothArguments& arguments, FlowOptions options, Smoothing& s,
              Progress& progress) {
  resolve(arguments, s.before(), s.topology, options, s.figures);
  s.held = held(arguments, s.file, s.topology, options.cutoff_factor);
  std::optional<PostponedEnd> postponed;
  if (!arguments.checkpoint.empty()) {
    postponed.emplace();
  }
  progress.begin_work("prepare");
  options.on_stage = [&progress](FlowStage stage) { progress.enter(stage); };
  s.figures.flow = willmore_flow(s.X, s.topology, s.held, options, [&](const StepRecord& step) {
    progress.advance(step, options.steps, options.total_time);
    return PostponedEnd::signal_number() == 0;
  });
  s.figures.total_time = options.total_time;
}

ExitCode forecast(const SmoothArguments& arguments, FlowOptions options, Smoothing& s,
                  Report& report, Console& console) {
  FlowForecast forecast;
  if (options.steps > 0) {
    resolve(arguments, s.before(), s.topology, options, s.figures);
    forecast = forecast_flow(s.X, s.topology,
                             held(arguments, s.file, s.topology, options.cutoff_factor), options);
  }
  report.figures["input"] = arguments.input;
  report.figures["forecast"] = forecast_json(forecast);
  deliver_report(arguments.report, arguments.output.write.overwrite, report);
  console.note(fmt::format("{}: {} of {} vertices would move in {} steps", arguments.input,
                           forecast.unknowns, s.topology.vertex_count, options.steps),
               forecast_table(forecast));
  return ExitCode::done;
}

/// What is left of the flow, in time steps of about the same length.
std::string way_on(const SmoothFigures& figures, int steps) {
  const double left = figures.total_time - figures.flow.time_reached;
  const double share = left / figures.total_time;
  if (!(share > 1e-9)) {
    return "the flow was complete";
  }
  const double count = std::max(1.0, std::ceil(share * steps - 1e-6));
  return fmt::format("`smooth` goes on from it with --steps {:.0f} --time-step {}, no --cutoff",
                     count, left / count);
}

/// What is to be said about the end of the flow; empty: it went as it should.
std::string remark_on(const SmoothFigures& figures, const OutputOptions& output, int steps) {
  switch (figures.flow.status) {
    case FlowStatus::completed:
      return steps > 0 && figures.flow.unknowns == 0
                 ? "no vertex is free to move: the mesh is written as it was read"
                 : "";
    case FlowStatus::interrupted:
      return fmt::format("interrupted; {} holds the state that was reached: {}", output.path,
                         way_on(figures, steps));
    case FlowStatus::stalled:
      return "the flow stalled before its time was up; the state it reached was written";
    case FlowStatus::diverged:
      return "the flow diverged; the last finite state was written (smaller steps, or no --plain)";
  }
  return {};
}

ExitCode exit_code_of(FlowStatus status) {
  return status == FlowStatus::completed ? ExitCode::done
         : status == FlowStatus::interrupted
             ? static_cast<ExitCode>(128 + PostponedEnd::signal_number())
             : ExitCode::not_reached;
}

/// The mesh before and after, and the border of what was held.
std::optional<Scene> smooth_scene(const SmoothArguments& arguments, const Smoothing& s,
                                  const std::vector<Warning>& warnings, const Console& console) {
  SceneSource source{arguments.input,
                     {{"before", &s.before(), &s.topology}, {"after", &s.X, &s.topology}},
                     arguments.flow.laplacian};
  source.polygons = &s.file.mesh().faces;
  if (!s.held.empty()) {
    source.lines = held_lines(s.X, s.topology, s.held);
  }
  return mesh_scene(std::move(source), warnings, console);
}

/// Writes the mesh that was reached, and says so.
void write_and_tell(const SmoothArguments& arguments, const OutputOptions& output, Smoothing& s,
                    Report& report, const Console& console, Progress& progress) {
  WriteReport written;
  progress.begin("write");
  {
    const Stopwatch watch(s.figures.seconds_write);
    written = write_mesh(s.file, s.X, output.path, output.write);
  }
  for (const std::string& note : written.notes) {
    console.note(note);
  }
  draw(arguments, s.topology, s.before(), s.X);
  progress.end();
  report.figures["input"] = arguments.input;
  report.figures["output"] = output.path;
  add_smooth_figures(s.figures, s.topology, arguments.flow, report);
  report.figures["defects"] = defects_json(s.topology);
  report.figures["moved_vertices"] = written.moved_vertices;
  console.note(fmt::format("{} -> {}, {} of {} vertices moved", arguments.input, output.path,
                           written.moved_vertices, s.X.rows()),
               smooth_table(s.figures, s.topology, console.level() == Console::Level::verbose));
}

/// The options of the flow as the mesh and other options have them.
FlowOptions flow_options(const SmoothArguments& arguments, const MeshFile& file,
                         const Topology& topology, const Console& console) {
  FlowOptions options = arguments.flow;
  options.mass = arguments.mass.mass();
  options.mass_matrix = arguments.mass.name;
  options.metric = arguments.metric == "mass" ? Metric::mass : Metric::identity;
  options.guarded = !arguments.plain;
  options.relax = relaxes(arguments, file, console);
  if (const std::vector<double>& a = arguments.anisotropy; !a.empty()) {
    options.material_axes = material_axes(file.mesh().X, topology, Vec3(a[0], a[1], a[2]), a[3]);
  }
  if (arguments.keep_sharp) {
    options.sharp_angle = *arguments.keep_sharp * std::numbers::pi / 180;
  }
  if (!arguments.weights.empty()) {
    options.cutoff_factor = vertex_values(file, arguments.weights, 0, "--weights");
  }
  if (!arguments.h0.empty()) {
    options.spontaneous_curvature = vertex_values_or_number(file, arguments.h0, "--h0");
  }
  return options;
}

ExitCode run_smooth(SmoothArguments arguments, const CLI::App& app, Console& console) {
  check_outputs(arguments);
  Progress progress(console);
  Smoothing s = read_smoothing(arguments, console, progress);
  warn_of_defects(s.topology, arguments.strict, console);
  Report report(app);
  report.warnings = defect_list(s.before(), s.topology);
  arguments.flow = flow_options(arguments, s.file, s.topology, console);
  const FlowOptions& options = arguments.flow;
  if (arguments.dry_run) {
    progress.end();
    return forecast(arguments, options, s, report, console);
  }
  progress.begin("measure");
  s.figures.mean_edge_length = mean_edge_length(s.before(), s.topology.E);
  s.figures.before = mesh_figures(s.before(), s.topology, options);
  if (options.steps > 0) {
    run_flow(arguments, options, s, progress);
  }
  progress.begin("measure");
  s.figures.after = mesh_figures(s.X, s.topology, options);
  measure_moves(s.before(), s.X, s.figures);

  const FlowStatus status = s.figures.flow.status;
  const OutputOptions output =
      status == FlowStatus::interrupted ? checkpoint_of(arguments) : arguments.output;
  write_and_tell(arguments, output, s, report, console, progress);
  if (const std::string remark = remark_on(s.figures, output, options.steps); !remark.empty()) {
    console.warning(remark);
    report.warnings.push_back({remark});
  }
  report.scene = [&] { return smooth_scene(arguments, s, report.warnings, console); };
  deliver_report(arguments.report, output.write.overwrite, report);
  return exit_code_of(status);
}

}  // namespace

Runner declare_smooth(CLI::App& app) {
  auto arguments = std::make_shared<SmoothArguments>();
  add_smooth_arguments(app, *arguments);
  return [arguments, &app](Console& console) { return run_smooth(*arguments, app, console); };
}

}  // namespace ibmfair::commands
