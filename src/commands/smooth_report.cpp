#include "commands/smooth_report.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "commands/cutoff_report.h"
#include "commands/report/report_formats.h"
#include "commands/smooth_remarks.h"
#include "commands/sparkline.h"
#include "commands/stage_times.h"
#include "commands/value_list.h"
#include "ibmfair/base/angle.h"
#include "ibmfair/base/process_memory.h"
#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/mass_matrices.h"
#include "ibmfair/flow/linear_system/jacobian_solver.h"

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
  if (result.plan.seconds_walls > 0) {
    seconds["walls"] = result.plan.seconds_walls;
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

/// The numbers of iterations and factorizations for the linear systems.
std::string effort(const FlowReport& flow) {
  const std::string factorizations =
      fmt::format("{} factorization{}", flow.factorizations, flow.factorizations == 1 ? "" : "s");
  return flow.iterations == 0 ? factorizations
         : flow.factorizations == 0
             ? fmt::format("{} iterations", flow.iterations)
             : fmt::format("{} iterations, {}", flow.iterations, factorizations);
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
  if (std::isfinite(before.volume)) {
    text += row(result.closed ? "volume" : "volume (cone)", "u^3", before.volume, after.volume);
  }
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
      {"tangential", tangential(options)},
      {"first_stage", options.first_stage == FirstStage::normals ? "normals" : "flow"}};
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

}  // namespace

void check_outputs(const SmoothArguments& arguments) {
  std::vector<OutputFile> files;
  if (!arguments.dry_run) {
    files = {{"", arguments.output.path},
             {"--picture", arguments.picture.path},
             {"--checkpoint", arguments.checkpoint}};
  }
  check_reports(arguments.report, files, arguments.output.write.overwrite);
}

OutputOptions output_of(const SmoothArguments& arguments, FlowStatus status) {
  OutputOptions output = arguments.output;
  if (status == FlowStatus::interrupted) {
    output.path = arguments.checkpoint;
    output.write.format.clear();
  }
  return output;
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
  for (const std::string& note : notes_on(arguments, result)) {
    console.note(note);
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
  for (const std::string& warning :
       {warning_on_volume(arguments, result), warning_on_walls(arguments, result),
        warning_on_end(arguments, result, output)}) {
    if (!warning.empty()) {
      console.warning(warning);
      report.warnings.push_back({warning});
    }
  }
}

}  // namespace ibmfair::commands
