#include "commands/smooth_report.h"

#include <algorithm>
#include <numbers>

#include <fmt/format.h>

#include "ibmfair/base/process_memory.h"
#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/flow/folds.h"
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

std::string row(const char* name, double before, double after) {
  return fmt::format("  {:<16}{:>14.6g}{:>14.6g}{:>+11.3f} %\n", name, before, after,
                     before != 0 ? 100 * (after / before - 1) : 0.0);
}

ordered_json state_json(const MeshFigures& figures) {
  return {{"energy", figures.energy},
          {"area", figures.area},
          {"volume", figures.volume},
          {"smallest_angle_degrees", figures.smallest_angle},
          {"folded_hinges", figures.folds}};
}

ordered_json steps_json(const FlowReport& flow) {
  ordered_json steps = ordered_json::array();
  for (const StepRecord& step : flow.steps) {
    steps.push_back({{"step", step.step},
                     {"time", step.time},
                     {"time_step", step.time_step},
                     {"energy", step.energy},
                     {"gradient_norm", step.gradient_norm},
                     {"largest_move", step.largest_move},
                     {"decrease_ratio", step.decrease_ratio},
                     {"refactored", step.refactored},
                     {"held_back", step.held_back}});
  }
  return steps;
}

ordered_json seconds_json(const SmoothFigures& figures) {
  const FlowSeconds& s = figures.flow.seconds;
  return {{"read", figures.seconds_read},
          {"topology", figures.seconds_topology},
          {"assemble", s.assemble},
          {"analyse", s.analyse},
          {"factor", s.factor},
          {"gradient", s.gradient},
          {"solve", s.solve},
          {"guard", s.guard},
          {"relax", s.relax},
          {"write", figures.seconds_write}};
}

/// What the linear systems took.
std::string effort(const FlowReport& flow) {
  return flow.solver == "cg" ? fmt::format("{} iterations", flow.iterations)
                             : fmt::format("{} factorization{}", flow.factorizations,
                                           flow.factorizations == 1 ? "" : "s");
}

}  // namespace

MeshFigures mesh_figures(const Points& X, const Topology& topology, const FlowOptions& options) {
  MeshFigures figures;
  figures.energy = bending_model(options.laplacian).bind(topology, {options.mass, {}})->energy(X);
  figures.area = surface_area(X, topology.F);
  figures.volume = enclosed_volume(X, topology.F);
  const Eigen::VectorXd angles = smallest_angles(X, topology.F);
  figures.smallest_angle = angles.size() > 0 ? angles.minCoeff() * 180 / std::numbers::pi : 0;
  figures.folds = (dihedral_angles(X, topology.H).array() < fold_angle).count();
  return figures;
}

std::string smooth_table(const SmoothFigures& figures, const Topology& topology) {
  const FlowReport& flow = figures.flow;
  const double edge = figures.mean_edge_length;
  std::string text = fmt::format("  {:<16}{:>14}{:>14}{:>13}\n", "", "before", "after", "change");
  text += row("bending energy", figures.before.energy, figures.after.energy);
  text += row("area", figures.before.area, figures.after.area);
  text += row(topology.boundary_loops.empty() ? "volume" : "volume (cone)", figures.before.volume,
              figures.after.volume);
  text += row("smallest angle", figures.before.smallest_angle, figures.after.smallest_angle);
  if (edge > 0) {
    text +=
        fmt::format("  vertices moved by at most {:.4g} ({:.3g} mean edge lengths), rms {:.4g}\n",
                    figures.largest_move, figures.largest_move / edge, figures.rms_move);
    text += fmt::format("  {} steps, {} solves, {}; cut-off {:.4g} ({:.3g} mean edge lengths)\n",
                        flow.steps.size(), flow.solves, effort(flow), figures.cutoff,
                        figures.cutoff / edge);
  }
  text += "  seconds:";
  const ordered_json seconds = seconds_json(figures);
  for (const auto& [stage, value] : seconds.items()) {
    text += fmt::format(" {} {:.3f}", stage, value.get<double>());
  }
  return text + "\n";
}

std::string forecast_table(const FlowForecast& forecast) {
  std::string text =
      fmt::format("  {:<10}{:>14}{:>12}{:>18}\n", "solver", "seconds/core", "MB", "factor entries");
  for (const BackendForecast& backend : forecast.backends) {
    const SolverForecast& f = backend.forecast;
    text += fmt::format("  {:<10}{:>14.2g}{:>12.0f}{:>18}{}\n", backend.solver, f.seconds,
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

void add_smooth_figures(ordered_json& report, const SmoothFigures& figures,
                        const Topology& topology, const FlowOptions& options) {
  const FlowReport& flow = figures.flow;
  report["status"] = name_of(flow.status);
  report["options"] = {{"laplacian", options.laplacian},
                       {"mass", options.mass},
                       {"metric", options.metric == Metric::mass ? "mass" : "identity"},
                       {"steps", options.steps},
                       {"total_time", figures.total_time},
                       {"cutoff", figures.cutoff},
                       {"newton_iterations", options.newton_iterations},
                       {"solver_tolerance", options.solver_tolerance},
                       {"guarded", options.guarded},
                       {"tangential", options.guarded && options.relax ? "relax" : "none"}};
  report["mesh"] = {{"vertices", topology.vertex_count},
                    {"triangles", topology.F.rows()},
                    {"unknowns", flow.unknowns},
                    {"mean_edge_length", figures.mean_edge_length}};
  report["before"] = state_json(figures.before);
  report["after"] = state_json(figures.after);
  report["largest_move"] = figures.largest_move;
  report["rms_move"] = figures.rms_move;
  report["flow"] = {{"energy_before", flow.energy_before},
                    {"energy_after", flow.energy_after},
                    {"time_reached", flow.time_reached},
                    {"solves", flow.solves},
                    {"solver", flow.solver},
                    {"iterations", flow.iterations},
                    {"factorizations", flow.factorizations},
                    {"rejected", flow.rejected},
                    {"shortened_relaxations", flow.shortened_relaxations},
                    {"ordering", flow.forecast.ordering},
                    {"factor_entries", flow.forecast.factor_entries},
                    {"factor_flops", flow.forecast.flops}};
  report["steps"] = steps_json(flow);
  report["seconds"] = seconds_json(figures);
}

}  // namespace ibmfair::commands
