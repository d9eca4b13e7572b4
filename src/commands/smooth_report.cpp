#include "commands/smooth_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "commands/figure_list.h"
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

ordered_json mesh_figures_json(const MeshFigures& figures) {
  return {{"energy", figures.energy},
          {"area", figures.area},
          {"volume", figures.volume},
          {"smallest_angle_degrees", figures.smallest_angle},
          {"folded_hinges", figures.folds}};
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

ordered_json seconds_json(const SmoothFigures& figures) {
  const FlowSeconds& s = figures.flow.seconds;
  ordered_json seconds{{"read", figures.seconds_read}, {"topology", figures.seconds_topology}};
  if (figures.choice) {
    seconds["choose"] = figures.seconds_choice;
  }
  if (figures.seconds_directions > 0) {
    seconds["directions"] = figures.seconds_directions;
  }
  seconds.update({{"assemble", s.assemble},
                  {"analyse", s.analyse},
                  {"factor", s.factor},
                  {"gradient", s.gradient},
                  {"solve", s.solve},
                  {"guard", s.guard},
                  {"relax", s.relax},
                  {"other", s.other},
                  {"measure", figures.seconds_measure},
                  {"write", figures.seconds_write}});
  return seconds;
}

StageTimes stage_times(const SmoothFigures& figures) {
  StageTimes times;
  const ordered_json seconds = seconds_json(figures);
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
std::string_view what_begins_anew(const SmoothArguments& arguments) {
  const bool bounded = arguments.max_move.has_value(), put_back = arguments.flow.twicing > 0;
  return bounded && put_back ? "; --max-move and --twicing then refer to that mesh"
         : bounded           ? "; --max-move then refers to that mesh"
         : put_back          ? "; --twicing then refers to that mesh"
                             : "";
}

/// The options that continue the flow, with time steps of about the same length.
std::string way_on(const SmoothFigures& figures, const SmoothArguments& arguments) {
  const double left = figures.total_time - figures.flow.time_reached;
  const double share = left / figures.total_time;
  if (!(share > 1e-9)) {
    return "the flow was complete";
  }
  const double count = std::max(1.0, std::ceil(share * arguments.flow.steps - 1e-6));
  return fmt::format(
      "to continue, smooth it with --steps {:.0f} --time-step {} and without --cutoff{}", count,
      left / count, what_begins_anew(arguments));
}

double length_reached(const SmoothFigures& figures) {
  return figures.cutoff * std::pow(figures.flow.time_reached / figures.total_time, 0.25);
}

/// Whether the flow has reached 99 % of the cut-off. A missing hundredth of the length is
/// invisible, and if thin triangles delay a flow until its last solve, the hundredth depends on
/// rounding.
bool is_nearly_done(const SmoothFigures& figures) {
  return length_reached(figures) >= 0.99 * figures.cutoff;
}

}  // namespace

MeshFigures mesh_figures(const Points& X, const Topology& topology, const FlowOptions& options) {
  return mesh_figures(
      X, topology,
      bending_model(options.laplacian).create(topology, options.energy_options())->energy(X));
}

MeshFigures mesh_figures(const Points& X, const Topology& topology, double energy) {
  MeshFigures figures;
  figures.energy = energy;
  figures.area = surface_area(X, topology.F);
  figures.volume = enclosed_volume(X, topology.F);
  figures.smallest_angle = degrees(smallest_angle(X, topology.F));
  const std::vector<std::uint8_t> folded = folded_hinges(X, topology);
  figures.folds = std::count(folded.begin(), folded.end(), 1);
  return figures;
}

ordered_json mesh_state_json(const Points& X, const Topology& topology,
                             const FlowOptions& options) {
  ordered_json json = mesh_figures_json(mesh_figures(X, topology, options));
  json["vertices"] = topology.vertex_count;
  json["triangles"] = topology.F.rows();
  json["boundary_loops"] = topology.boundary_loops.size();
  return json;
}

std::string cutoff_lines(const SmoothFigures& figures, bool detailed) {
  const double edge = figures.mean_edge_length;
  std::string text = fmt::format("  {:<16}{}\n", "cut-off", length_text(figures.cutoff, edge));
  if (figures.choice) {
    text += fmt::format("  {:<16}{}\n", "noise", length_text(figures.choice->noise, edge));
    if (const auto& creases = figures.creases) {
      text += fmt::format(
          "  {:<16}edges of more than {:.0f} degrees are kept; without that the error would be "
          "{:.3g} mean edge lengths\n",
          "creases", degrees(creases->sharp_angle),
          expected_distance(creases->without.best()) / edge);
    }
    if (detailed) {
      text += fmt::format("  {:<16}{:>7}{:>17}  mean edge lengths\n", "tried", "cut-off",
                          "distance left");
      for (const CutoffTrial& trial : figures.choice->trials) {
        text += fmt::format("  {:<16}{:>7.3g}{:>17.3g}\n", "", trial.cutoff / edge,
                            expected_distance(trial) / edge);
      }
    }
  }
  return text;
}

std::string smooth_table(const SmoothFigures& figures, bool detailed) {
  const FlowReport& flow = figures.flow;
  const MeshFigures &before = figures.before, &after = figures.after;
  const double edge = figures.mean_edge_length;
  std::string text =
      fmt::format("  {:<16}{:<10}{:>12}{:>12}{:>13}\n", "", "unit", "before", "after", "change");
  text += row("bending energy", "1", before.energy, after.energy);
  text += row("area", "u^2", before.area, after.area);
  text += row(figures.closed ? "volume" : "volume (cone)", "u^3", before.volume, after.volume);
  text += row("smallest angle", "degrees", before.smallest_angle, after.smallest_angle);
  text += fmt::format("  {:<16}{:<10}{:>12}{:>12}{:>+13}\n", "folds", "hinges", before.folds,
                      after.folds, after.folds - before.folds);
  if (edge > 0) {
    text +=
        fmt::format("  {:<16}{}; rms {}\n", "largest move", length_text(figures.largest_move, edge),
                    length_text(figures.rms_move, edge));
    text += cutoff_lines(figures, detailed);
  }
  if (detailed) {
    text += curve(flow);
  }
  return text +
         fmt::format("  {:<16}{} steps, {} solves, {}\n", "effort", flow.steps.size(), flow.solves,
                     effort(flow)) +
         stage_times_line(stage_times(figures), detailed);
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

void add_cutoff_choice(const SmoothFigures& figures, Report& report) {
  if (!figures.choice) {
    return;
  }
  ordered_json trials = ordered_json::array();
  for (const CutoffTrial& trial : figures.choice->trials) {
    trials.push_back({{"cutoff", trial.cutoff}, {"distance_expected", expected_distance(trial)}});
  }
  ordered_json& json = report.figures["cutoff_choice"];
  json = {{"cutoff", figures.choice->cutoff}, {"noise", figures.choice->noise}, {"trials", trials}};
  if (const auto& creases = figures.creases) {
    json["keep_sharp"] = degrees(creases->sharp_angle);
    json["distance_expected_without"] = expected_distance(creases->without.best());
  }
}

void add_smooth_figures(const SmoothFigures& figures, const FlowOptions& options, Report& report) {
  const FlowReport& flow = figures.flow;
  ordered_json& json = report.figures;
  json["status"] = name_of(flow.status);
  json["options"] = {
      {"laplacian", options.laplacian},
      {"mass", options.mass},
      {"mass_matrix",
       mass_matrix(bending_model(options.laplacian), {options.mass, {}, options.mass_matrix}).name},
      {"metric", options.metric == Metric::mass ? "mass" : "identity"},
      {"steps", options.steps},
      {"total_time", figures.total_time},
      {"cutoff", figures.cutoff},
      {"newton_iterations", options.newton_iterations},
      {"twicing", options.twicing},
      {"solver_tolerance", options.solver_tolerance},
      {"guarded", options.guarded},
      {"tangential", tangential(options)}};
  add_cutoff_choice(figures, report);
  json["mesh"] = {{"vertices", figures.vertices},
                  {"triangles", figures.triangles},
                  {"unknowns", flow.unknowns},
                  {"mean_edge_length", figures.mean_edge_length}};
  json["before"] = mesh_figures_json(figures.before);
  json["after"] = mesh_figures_json(figures.after);
  json["largest_move"] = figures.largest_move;
  json["rms_move"] = figures.rms_move;
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
  json["seconds"] = seconds_json(figures);
}

std::string remark_on(const SmoothFigures& figures, const std::string& output,
                      const SmoothArguments& arguments) {
  switch (figures.flow.status) {
    case FlowStatus::completed:
      if (arguments.flow.steps > 0 && figures.flow.unknowns == 0) {
        return "no vertex is free to move: the mesh is written as it was read";
      }
      return figures.flow.twicings < arguments.flow.twicing && arguments.flow.steps > 0
                 ? fmt::format(
                       "--twicing: the removed part could be added back only {} of {} times",
                       figures.flow.twicings, arguments.flow.twicing)
                 : "";
    case FlowStatus::interrupted:
      return fmt::format("interrupted; {} holds the mesh as it is now: {}", output,
                         way_on(figures, arguments));
    case FlowStatus::stalled:
      return is_nearly_done(figures)
                 ? ""
                 : fmt::format(
                       "the flow stalled: the mesh that was written is smoothed up to a wavelength "
                       "of {:.4g} instead of {:.4g}",
                       length_reached(figures), figures.cutoff);
    case FlowStatus::diverged:
      return "the flow diverged, and the last finite mesh was written; take smaller steps, or "
             "leave out --plain";
  }
  return {};
}

ExitCode exit_code_of(const SmoothFigures& figures) {
  switch (figures.flow.status) {
    case FlowStatus::completed:
      return ExitCode::done;
    case FlowStatus::interrupted:
      return static_cast<ExitCode>(128 + PostponedEnd::signal_number());
    case FlowStatus::stalled:
      return is_nearly_done(figures) ? ExitCode::done : ExitCode::not_reached;
    case FlowStatus::diverged:
      break;
  }
  return ExitCode::not_reached;
}

}  // namespace ibmfair::commands
