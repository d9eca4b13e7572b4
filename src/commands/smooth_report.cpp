#include "commands/smooth_report.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "commands/figure_list.h"
#include "commands/report/report_formats.h"
#include "commands/signals.h"
#include "commands/sparkline.h"
#include "commands/stage_times.h"
#include "ibmfair/base/angle.h"
#include "ibmfair/base/process_memory.h"
#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/mass_matrices.h"
#include "ibmfair/flow/linear_system/jacobian_solver.h"
#include "ibmfair/flow/steps/folds.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair::commands {
namespace {

using nlohmann::ordered_json;

const char* name_of(FlowStatus status) {
  switch (status) {
    case FlowStatus::completed:
      return "completed";
    case FlowStatus::interrupted:
      return "interrupted";
    case FlowStatus::stalled:
      return "stalled";
    case FlowStatus::diverged:
      return "diverged";
  }
  return "unknown";
}

const char* tangential(const FlowOptions& options) {
  if (options.put_back_slides) {
    return "keep";
  }
  if (options.guarded && options.relax) {
    return "relax";
  }
  return options.guarded && options.relax_first && options.sharp_angle > 0 ? "first" : "none";
}

std::string row(const char* name, const char* unit, double before, double after) {
  return fmt::format("  {:<16}{:<10}{:>12.5g}{:>12.5g}{:>13}\n", name, unit, before, after,
                     change_text(before, after));
}

/// A length in the mesh's units and in mean edge lengths.
std::string length_text(double length, double edge) {
  return fmt::format("{:.4g} u = {:.3g} mean edge lengths", length, length / edge);
}

ordered_json mesh_statistics_json(const MeshStatistics& statistics) {
  return {{"energy", statistics.energy},
          {"area", statistics.area},
          {"volume", statistics.volume},
          {"smallest_angle_degrees", statistics.smallest_angle},
          {"folded_hinges", statistics.folds}};
}

ordered_json step_json(const StepRecord& step) {
  return {{"step", step.step},
          {"time", step.time},
          {"time_step", step.time_step},
          {"energy", step.energy},
          {"gradient_norm", step.gradient_norm},
          {"largest_move", step.largest_move},
          {"decrease_ratio", step.decrease_ratio},
          {"refactored", step.refactored},
          {"held_back", step.held_back}};
}

ordered_json seconds_json(const SmoothResult& result) {
  const FlowSeconds& s = result.flow.seconds;
  ordered_json seconds{{"read", result.seconds_read}, {"topology", result.seconds_topology}};
  if (result.plan.choice) {
    seconds["choose"] = result.plan.seconds_choice;
  }
  if (result.plan.seconds_directions > 0) {
    seconds["directions"] = result.plan.seconds_directions;
  }
  seconds.update({{"assemble", s.assemble},
                  {"analyse", s.analyse},
                  {"factor", s.factor},
                  {"gradient", s.gradient},
                  {"solve", s.solve},
                  {"guard", s.guard},
                  {"relax", s.relax},
                  {"other", s.other},
                  {"measure", result.seconds_measure},
                  {"write", result.seconds_write}});
  return seconds;
}

StageTimes stage_times(const SmoothResult& result) {
  StageTimes times;
  const ordered_json seconds = seconds_json(result);
  for (const auto& [stage, value] : seconds.items()) {
    times.emplace_back(stage, value.get<double>());
  }
  return times;
}

/// The energy at the start and after each step, as a curve.
std::string curve(const FlowReport& flow) {
  constexpr std::size_t columns = 60;
  std::vector<double> energies{flow.energy_before};
  for (const StepRecord& step : flow.steps) {
    if (std::isfinite(step.energy)) {
      energies.push_back(step.energy);
    }
  }
  return flow.steps.empty()
             ? std::string()
             : fmt::format("  {:<16}{} {:.4g} to {:.4g}{}\n", "energy by step",
                           sparkline(energies, columns, locale_is_utf8()), energies.front(),
                           energies.back(), drawn_logarithmically(energies) ? ", logarithmic" : "");
}

/// The distance to the surface without noise that a trial of a cut-off is expected to leave.
double expected_distance(const CutoffTrial& trial) {
  return std::sqrt(std::max(trial.risk, 0.0));
}

/// The numbers of iterations and factorizations for the linear systems.
std::string effort(const FlowReport& flow) {
  const std::string factorizations =
      fmt::format("{} factorization{}", flow.factorizations, flow.factorizations == 1 ? "" : "s");
  return flow.iterations == 0 ? factorizations
         : flow.factorizations == 0
             ? fmt::format("{} iterations", flow.iterations)
             : fmt::format("{} iterations, {}", flow.iterations, factorizations);
}

/// A remark about options that refer to the original mesh, but that a continued run would apply to
/// the mesh written here.
std::string_view what_begins_anew(const FlowOptions& options) {
  const bool bounded = std::isfinite(options.max_move), put_back = options.twicing > 0;
  return bounded && put_back ? "; --max-move and --twicing then refer to that mesh"
         : bounded           ? "; --max-move then refers to that mesh"
         : put_back          ? "; --twicing then refers to that mesh"
                             : "";
}

/// The options that continue the flow, with time steps of about the same length.
std::string way_on(const SmoothResult& result) {
  const double left = result.plan.flow.total_time - result.flow.time_reached;
  const double share = left / result.plan.flow.total_time;
  if (!(share > 1e-9)) {
    return "the flow was complete";
  }
  const double count = std::max(1.0, std::ceil(share * result.plan.flow.steps - 1e-6));
  return fmt::format(
      "to continue, smooth it with --steps {:.0f} --time-step {} and without --cutoff{}", count,
      left / count, what_begins_anew(result.plan.flow));
}

double length_reached(const SmoothResult& result) {
  return result.plan.cutoff *
         std::pow(result.flow.time_reached / result.plan.flow.total_time, 0.25);
}

/// Whether the flow has reached 99 % of the cut-off. A missing hundredth of the length is
/// invisible, and if thin triangles delay a flow until its last solve, the hundredth depends on
/// rounding.
bool is_nearly_done(const SmoothResult& result) {
  return length_reached(result) >= 0.99 * result.plan.cutoff;
}

/// Lines with the cut-off and, if it was chosen automatically, the noise that it was chosen from.
/// If `detailed`, also all cut-offs that were tried.
std::string cutoff_lines(const SmoothPlan& plan, bool detailed) {
  const double edge = plan.mean_edge_length;
  std::string text = fmt::format("  {:<16}{}\n", "cut-off", length_text(plan.cutoff, edge));
  if (plan.choice) {
    text += fmt::format("  {:<16}{}\n", "noise", length_text(plan.choice->noise, edge));
    if (const auto& creases = plan.creases) {
      text += fmt::format(
          "  {:<16}edges of more than {:.0f} degrees are kept; without that the error would be "
          "{:.3g} mean edge lengths\n",
          "creases", degrees(creases->sharp_angle),
          expected_distance(creases->without.best()) / edge);
    }
    if (detailed) {
      text += fmt::format("  {:<16}{:>7}{:>17}  mean edge lengths\n", "tried", "cut-off",
                          "distance left");
      for (const CutoffTrial& trial : plan.choice->trials) {
        text += fmt::format("  {:<16}{:>7.3g}{:>17.3g}\n", "", trial.cutoff / edge,
                            expected_distance(trial) / edge);
      }
    }
  }
  return text;
}

/// A table of aligned lines, ending in a line feed: the statistics before and after, and the effort
/// of the run. If `detailed`, also a curve of the energy after each step, and the times of all
/// stages.
std::string smooth_table(const SmoothResult& result, bool detailed) {
  const FlowReport& flow = result.flow;
  const MeshStatistics &before = result.before, &after = result.after;
  const double edge = result.plan.mean_edge_length;
  std::string text =
      fmt::format("  {:<16}{:<10}{:>12}{:>12}{:>13}\n", "", "unit", "before", "after", "change");
  text += row("bending energy", "1", before.energy, after.energy);
  text += row("area", "u^2", before.area, after.area);
  text += row(result.closed ? "volume" : "volume (cone)", "u^3", before.volume, after.volume);
  text += row("smallest angle", "degrees", before.smallest_angle, after.smallest_angle);
  text += fmt::format("  {:<16}{:<10}{:>12}{:>12}{:>+13}\n", "folds", "hinges", before.folds,
                      after.folds, after.folds - before.folds);
  if (edge > 0) {
    text += fmt::format("  {:<16}{}; rms {}\n", "largest move",
                        length_text(result.largest_move, edge), length_text(result.rms_move, edge));
    text += cutoff_lines(result.plan, detailed);
  }
  if (detailed) {
    text += curve(flow);
  }
  return text +
         fmt::format("  {:<16}{} steps, {} solves, {}\n", "effort", flow.steps.size(), flow.solves,
                     effort(flow)) +
         stage_times_line(stage_times(result), detailed);
}

std::string forecast_table(const FlowForecast& forecast) {
  std::string text =
      fmt::format("  {:<13}{:>14}{:>12}{:>18}\n", "solver", "seconds/core", "MB", "factor entries");
  for (const BackendForecast& backend : forecast.backends) {
    const SolverForecast& f = backend.forecast;
    text += fmt::format("  {:<13}{:>14.2g}{:>12.0f}{:>18}{}\n", backend.solver, f.seconds,
                        (resident_bytes() + f.bytes) / 1e6,
                        f.factor_entries > 0 ? fmt::format("{:.2g}", f.factor_entries) : "-",
                        backend.solver == forecast.solver ? "  <- would be used" : "");
  }
  return text;
}

ordered_json forecast_json(const FlowForecast& forecast) {
  ordered_json backends = ordered_json::array();
  for (const BackendForecast& backend : forecast.backends) {
    backends.push_back({{"solver", backend.solver},
                        {"seconds", backend.forecast.seconds},
                        {"bytes", resident_bytes() + backend.forecast.bytes},
                        {"factor_entries", backend.forecast.factor_entries}});
  }
  return {{"unknowns", forecast.unknowns}, {"solver", forecast.solver}, {"solvers", backends}};
}

/// Adds to the report how the cut-off was chosen, if it was chosen automatically.
void add_cutoff_choice(const SmoothPlan& plan, Report& report) {
  if (!plan.choice) {
    return;
  }
  ordered_json trials = ordered_json::array();
  for (const CutoffTrial& trial : plan.choice->trials) {
    trials.push_back({{"cutoff", trial.cutoff}, {"distance_expected", expected_distance(trial)}});
  }
  ordered_json& json = report.figures["cutoff_choice"];
  json = {{"cutoff", plan.choice->cutoff}, {"noise", plan.choice->noise}, {"trials", trials}};
  if (const auto& creases = plan.creases) {
    json["keep_sharp"] = degrees(creases->sharp_angle);
    json["distance_expected_without"] = expected_distance(creases->without.best());
  }
}

/// Adds to the report the result of the run, and its steps as a table.
void add_result(const SmoothResult& result, Report& report) {
  const FlowOptions& options = result.plan.flow;
  const FlowReport& flow = result.flow;
  ordered_json& json = report.figures;
  json["status"] = name_of(flow.status);
  json["options"] = {
      {"laplacian", options.laplacian},
      {"mass", options.mass},
      {"mass_matrix",
       mass_matrix(bending_model(options.laplacian), {options.mass, {}, options.mass_matrix}).name},
      {"metric", options.metric == Metric::mass ? "mass" : "identity"},
      {"steps", options.steps},
      {"total_time", result.plan.flow.total_time},
      {"cutoff", result.plan.cutoff},
      {"newton_iterations", options.newton_iterations},
      {"twicing", options.twicing},
      {"solver_tolerance", options.solver_tolerance},
      {"guarded", options.guarded},
      {"tangential", tangential(options)}};
  add_cutoff_choice(result.plan, report);
  json["mesh"] = {{"vertices", result.vertices},
                  {"triangles", result.triangles},
                  {"unknowns", flow.unknowns},
                  {"mean_edge_length", result.plan.mean_edge_length}};
  json["before"] = mesh_statistics_json(result.before);
  json["after"] = mesh_statistics_json(result.after);
  json["largest_move"] = result.largest_move;
  json["rms_move"] = result.rms_move;
  json["flow"] = {{"energy_before", flow.energy_before},
                  {"energy_after", flow.energy_after},
                  {"time_reached", flow.time_reached},
                  {"solves", flow.solves},
                  {"solver", flow.solver},
                  {"iterations", flow.iterations},
                  {"twicings", flow.twicings},
                  {"factorizations", flow.factorizations},
                  {"rejected", flow.rejected},
                  {"shortened_relaxations", flow.shortened_relaxations},
                  {"caught_up_vertices", flow.caught_up},
                  {"unfolded_vertices", flow.unfolded},
                  {"ordering", flow.forecast.ordering},
                  {"factor_entries", flow.forecast.factor_entries},
                  {"factor_flops", flow.forecast.flops}};
  for (const JacobianBackend& backend : jacobian_backends()) {
    if (backend.name == flow.solver && backend.load != nullptr) {
      report.add_components(backend.load());
    }
  }
  json["steps"] = ordered_json::array();
  report.table = Table{step_json({}), {}};
  for (const StepRecord& step : flow.steps) {
    json["steps"].push_back(step_json(step));
    report.table->rows.push_back(step_json(step));
  }
  json["seconds"] = seconds_json(result);
}

/// A remark if the flow did not end as requested; else empty. The final state of the flow is in the
/// file `output`.
std::string remark_on(const SmoothResult& result, const std::string& output) {
  switch (result.flow.status) {
    case FlowStatus::completed:
      if (result.plan.flow.steps > 0 && result.flow.unknowns == 0) {
        return "no vertex is free to move: the mesh is written as it was read";
      }
      return result.flow.twicings < result.plan.flow.twicing && result.plan.flow.steps > 0
                 ? fmt::format(
                       "--twicing: the removed part could be added back only {} of {} times",
                       result.flow.twicings, result.plan.flow.twicing)
                 : "";
    case FlowStatus::interrupted:
      return fmt::format("interrupted; {} holds the mesh as it is now: {}", output, way_on(result));
    case FlowStatus::stalled:
      return is_nearly_done(result)
                 ? ""
                 : fmt::format(
                       "the flow stalled: the mesh that was written is smoothed up to a wavelength "
                       "of {:.4g} instead of {:.4g}",
                       length_reached(result), result.plan.cutoff);
    case FlowStatus::diverged:
      return "the flow diverged, and the last finite mesh was written; take smaller steps, or "
             "leave out --plain";
  }
  return {};
}

/// A remark if the default cut-off has smoothed the mesh strongly; else empty.
std::string remark_on_default_cutoff(const SmoothResult& result) {
  if (result.plan.cutoff > result.plan.diagonal / 2) {
    return fmt::format(
        "the cut-off {:.4g} is more than half of the mesh's diagonal {:.4g}, so that the whole "
        "shape is smoothed; a shorter --cutoff LENGTH keeps the shape",
        result.plan.cutoff, result.plan.diagonal);
  }
  constexpr double large_change = 0.01;
  constexpr double solid = 0.05;  // share of the volume of a ball of equal area; below: a sheet
  const double volume = std::abs(result.before.volume);
  const double ball = std::pow(result.before.area, 1.5) / (6 * std::sqrt(std::numbers::pi));
  const double change = std::abs(result.after.volume) / volume - 1;
  if (volume > solid * ball && std::abs(change) > large_change) {
    return fmt::format(
        "the volume has changed by {:+.2g} %: the mesh has features that are shorter than the "
        "cut-off {:.4g}; --denoise removes noise only, and a shorter --cutoff LENGTH keeps longer "
        "features",
        100 * change, result.plan.cutoff);
  }
  return {};
}

/// A remark about the texture coordinates; empty if there is nothing to say.
std::string remark_on_texture(const SmoothArguments& arguments, const SmoothPlan& plan) {
  const FlowOptions& options = plan.flow;
  if (!plan.textured) {
    return {};
  }
  if (bending_model(options.laplacian).evens_edges) {
    return fmt::format(
        "the mesh has texture coordinates; with --laplacian {} vertices slide within the surface, "
        "and the texture shifts a little{}",
        options.laplacian,
        options.twicing > 0 && !options.put_back_slides ? " (less with --tangential keep)" : "");
  }
  if (arguments.tangential.empty() && options.guarded) {
    return fmt::format("the mesh has texture coordinates: {} (--tangential relax overrides this)",
                       options.sharp_angle > 0 ? "tangential relaxation only in the first steps"
                                               : "no tangential relaxation");
  }
  return {};
}

}  // namespace

void check_outputs(const SmoothArguments& arguments) {
  check_reports(arguments.report,
                {{"", arguments.output.path},
                 {"--picture", arguments.picture.path},
                 {"--checkpoint", arguments.checkpoint}},
                arguments.output.write.overwrite);
}

OutputOptions output_of(const SmoothArguments& arguments, FlowStatus status) {
  OutputOptions output = arguments.output;
  if (status == FlowStatus::interrupted) {
    output.path = arguments.checkpoint;
    output.write.format.clear();
  }
  return output;
}

MeshStatistics mesh_statistics(const Points& X, const Topology& topology,
                               const FlowOptions& options) {
  return mesh_statistics(
      X, topology,
      bending_model(options.laplacian).create(topology, options.energy_options())->energy(X));
}

MeshStatistics mesh_statistics(const Points& X, const Topology& topology, double energy) {
  MeshStatistics statistics;
  statistics.energy = energy;
  statistics.area = surface_area(X, topology.F);
  statistics.volume = enclosed_volume(X, topology.F);
  statistics.smallest_angle = degrees(smallest_angle(X, topology.F));
  const std::vector<std::uint8_t> folded = folded_hinges(X, topology);
  statistics.folds = std::count(folded.begin(), folded.end(), 1);
  return statistics;
}

ordered_json mesh_state_json(const Points& X, const Topology& topology,
                             const FlowOptions& options) {
  ordered_json json = mesh_statistics_json(mesh_statistics(X, topology, options));
  json["vertices"] = topology.vertex_count;
  json["triangles"] = topology.F.rows();
  json["boundary_loops"] = topology.boundary_loops.size();
  return json;
}

void measure_moves(const Points& before, const Points& after, SmoothResult& result) {
  if (before.rows() > 0) {
    const Eigen::VectorXd squared = (after - before).rowwise().squaredNorm();
    result.largest_move = std::sqrt(squared.maxCoeff());
    result.rms_move = std::sqrt(squared.mean());
  }
}

void print_forecast(const SmoothArguments& arguments, const SmoothResult& result,
                    const FlowForecast& forecast, const Console& console, Report& report) {
  report.figures["input"] = arguments.input;
  add_cutoff_choice(result.plan, report);
  report.figures["forecast"] = forecast_json(forecast);
  console.note(
      fmt::format("{}: {} of {} vertices would move in {} steps", arguments.input,
                  forecast.unknowns, result.vertices, result.plan.flow.steps),
      (result.plan.choice ? cutoff_lines(result.plan, true) : "") + forecast_table(forecast));
}

void print_result(const SmoothArguments& arguments, const SmoothResult& result,
                  const std::string& output, const WriteReport& written, std::string_view by,
                  const Console& console, Report& report) {
  if (const std::string remark = remark_on_texture(arguments, result.plan); !remark.empty()) {
    console.note(remark);
  }
  if (!arguments.cutoff && !result.plan.choice && !arguments.time_step) {
    if (const std::string remark = remark_on_default_cutoff(result); !remark.empty()) {
      console.note(remark);
    }
  }
  for (const std::string& note : written.notes) {
    console.note(note);
  }
  report.figures["input"] = arguments.input;
  report.figures["output"] = output;
  add_result(result, report);
  report.figures["moved_vertices"] = written.moved_vertices;
  console.note(fmt::format("{} -> {}, {} of {} vertices moved{}", arguments.input, output,
                           written.moved_vertices, result.vertices, by),
               smooth_table(result, console.level() == Console::Level::verbose));
  if (const std::string remark = remark_on(result, output); !remark.empty()) {
    console.warning(remark);
    report.warnings.push_back({remark});
  }
}

ExitCode exit_code_of(const SmoothResult& result) {
  switch (result.flow.status) {
    case FlowStatus::completed:
      return ExitCode::done;
    case FlowStatus::interrupted:
      return static_cast<ExitCode>(128 + PostponedEnd::signal_number());
    case FlowStatus::stalled:
      return is_nearly_done(result) ? ExitCode::done : ExitCode::not_reached;
    case FlowStatus::diverged:
      break;
  }
  return ExitCode::not_reached;
}

}  // namespace ibmfair::commands
