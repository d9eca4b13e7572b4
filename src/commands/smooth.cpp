#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/command.h"
#include "commands/defect_warnings.h"
#include "commands/progress.h"
#include "commands/signals.h"
#include "commands/smooth_arguments.h"
#include "commands/smooth_report.h"
#include "commands/vertex_list.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/base/stopwatch.h"
#include "ibmfair/flow/held_vertices.h"
#include "ibmfair/flow/time_scale.h"
#include "ibmfair/flow/willmore_flow.h"
#include "ibmfair/io/atomic_file.h"
#include "ibmfair/mesh/geometry.h"

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
                               const Topology& topology) {
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

void run_flow(const SmoothArguments& arguments, FlowOptions options, const MeshFile& file,
              const Topology& topology, Points& X, SmoothFigures& figures, Console& console,
              Progress& progress) {
  resolve(arguments, X, topology, options, figures);
  const auto held_vertices = held(arguments, file, topology);
  std::optional<PostponedEnd> postponed;
  if (!arguments.checkpoint.empty()) {
    postponed.emplace();
  }
  progress.begin_work("flow");
  options.on_stage = [&progress](FlowStage stage) { progress.enter(stage); };
  figures.flow = willmore_flow(X, topology, held_vertices, options, [&](const StepRecord& step) {
    progress.advance(step, options.steps, options.total_time);
    return PostponedEnd::signal_number() == 0;
  });
  figures.total_time = options.total_time;
  if (figures.flow.unknowns == 0) {
    console.warning("no vertex is free to move: the mesh is written as it was read");
  }
}

ExitCode forecast(const SmoothArguments& arguments, FlowOptions options, const MeshFile& file,
                  const Topology& topology, Console& console) {
  SmoothFigures figures;
  FlowForecast forecast;
  if (options.steps > 0) {
    const Points& X = file.mesh().X;
    resolve(arguments, X, topology, options, figures);
    forecast = forecast_flow(X, topology, held(arguments, file, topology), options);
  }
  nlohmann::ordered_json report = start_report("smooth");
  report["input"] = arguments.input;
  report["forecast"] = forecast_json(forecast);
  deliver_report(arguments.report, arguments.output.write.overwrite, report);
  console.note(fmt::format("{}: {} of {} vertices would move in {} steps", arguments.input,
                           forecast.unknowns, topology.vertex_count, options.steps),
               forecast_table(forecast));
  return ExitCode::done;
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
  const bool overwrite = arguments.output.write.overwrite;
  require_writable(arguments.output.path, overwrite);
  check_report(arguments.report, arguments.output.path, overwrite);
  check_picture(arguments.picture, overwrite);
  if (!arguments.checkpoint.empty()) {
    if (arguments.checkpoint == arguments.output.path) {
      throw BadOption("--checkpoint: '" + arguments.checkpoint + "' is the output already");
    }
    require_writable(arguments.checkpoint, overwrite);
  }
}

void check_formats(const SmoothArguments& arguments, const MeshFile& file) {
  require_writable_format(file, arguments.output.path, arguments.output.write);
  if (!arguments.checkpoint.empty()) {
    const OutputOptions checkpoint = checkpoint_of(arguments);
    require_writable_format(file, checkpoint.path, checkpoint.write);
  }
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

ExitCode conclude(FlowStatus status, const Console& console) {
  switch (status) {
    case FlowStatus::completed:
      return ExitCode::done;
    case FlowStatus::interrupted:
      return static_cast<ExitCode>(128 + PostponedEnd::signal_number());
    case FlowStatus::stalled:
      console.warning("the flow stalled before its time was up; the state it reached was written");
      return ExitCode::not_reached;
    case FlowStatus::diverged:
      console.warning(
          "the flow diverged; the last finite state was written (smaller steps, or no --plain)");
      return ExitCode::not_reached;
  }
  return ExitCode::internal_error;
}

ExitCode run_smooth(const SmoothArguments& arguments, Console& console) {
  check_outputs(arguments);
  SmoothFigures figures;
  std::optional<MeshFile> file;
  Progress progress(console);
  progress.begin("read");
  {
    const Stopwatch watch(figures.seconds_read);
    file = read_input(arguments.input, arguments.reading, console);
  }
  check_formats(arguments, *file);
  const Points before = file->mesh().X;
  Topology topology;
  progress.begin("connect");
  {
    const Stopwatch watch(figures.seconds_topology);
    topology = build_topology(before, triangulate(file->mesh()).F);
  }
  warn_of_defects(topology, arguments.strict, console);

  FlowOptions options = arguments.flow;
  options.mass = !arguments.no_mass;
  options.metric = arguments.metric == "mass" ? Metric::mass : Metric::identity;
  options.guarded = !arguments.plain;
  options.relax = relaxes(arguments, *file, console);
  SmoothArguments resolved = arguments;
  resolved.flow = options;
  if (arguments.dry_run) {
    progress.end();
    return forecast(resolved, options, *file, topology, console);
  }
  progress.begin("measure");
  figures.mean_edge_length = mean_edge_length(before, topology.E);
  figures.before = mesh_figures(before, topology, options);
  Points after = before;
  if (options.steps > 0) {
    run_flow(resolved, options, *file, topology, after, figures, console, progress);
  }
  progress.begin("measure");
  figures.after = mesh_figures(after, topology, options);
  measure_moves(before, after, figures);

  const bool interrupted = figures.flow.status == FlowStatus::interrupted;
  const OutputOptions output = interrupted ? checkpoint_of(arguments) : arguments.output;
  WriteReport written;
  progress.begin("write");
  {
    const Stopwatch watch(figures.seconds_write);
    written = write_mesh(*file, after, output.path, output.write);
  }
  for (const std::string& note : written.notes) {
    console.note(note);
  }
  draw(arguments, topology, before, after);
  progress.end();
  nlohmann::ordered_json report = start_report("smooth");
  report["input"] = arguments.input;
  report["output"] = output.path;
  add_smooth_figures(report, figures, topology, options);
  report["defects"] = defects_json(topology);
  report["moved_vertices"] = written.moved_vertices;
  deliver_report(arguments.report, output.write.overwrite, report);
  console.note(fmt::format("{} -> {}, {} of {} vertices moved", arguments.input, output.path,
                           written.moved_vertices, before.rows()),
               smooth_table(figures, topology, console.level() == Console::Level::verbose));
  if (interrupted) {
    console.warning(fmt::format("interrupted; {} holds the state that was reached: {}", output.path,
                                way_on(figures, options.steps)));
  }
  return conclude(figures.flow.status, console);
}

}  // namespace

Runner declare_smooth(CLI::App& app) {
  auto arguments = std::make_shared<SmoothArguments>();
  add_smooth_arguments(app, *arguments);
  return [arguments](Console& console) { return run_smooth(*arguments, console); };
}

}  // namespace ibmfair::commands
