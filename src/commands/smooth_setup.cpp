#include "commands/smooth_setup.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "commands/denoise_defaults.h"
#include "commands/report/report_formats.h"
#include "commands/signals.h"
#include "ibmfair/base/angle.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/base/stopwatch.h"
#include "ibmfair/flow/fixed_vertices.h"
#include "ibmfair/flow/part_measures.h"
#include "ibmfair/flow/settings/crease_choice.h"
#include "ibmfair/flow/time_scale.h"
#include "ibmfair/flow/willmore_flow.h"

namespace ibmfair::commands {
namespace {

/// Without --cutoff and --time-step, the time step is such that `default_steps` steps reach the
/// default cut-off; more steps smooth more.
constexpr int default_steps = 16;
constexpr double default_cutoff_edges = 8;

/// The total time in the flow's unit: the number of steps times --time-step, or the time for
/// --cutoff.
double total_time(const SmoothArguments& arguments, const Points& X, const Topology& topology,
                  const MeshParts& parts) {
  if (arguments.time_step) {
    return *arguments.time_step * arguments.flow.steps;
  }
  const Length cutoff = arguments.cutoff.value_or(Length{default_cutoff_edges});
  const double time = time_for_cutoff(cutoff.on(X, topology, parts));
  const double shares = arguments.cutoff ? arguments.flow.steps : default_steps;
  const double total =
      time_in_flow_units(time, X, topology, arguments.flow, parts) / shares * arguments.flow.steps;
  if (!(total > 0 && std::isfinite(total))) {
    throw BadMesh(fmt::format("edges of mean length {} are too {} to smooth",
                              mean_edge_length(X, topology, parts), total > 0 ? "long" : "short"));
  }
  return total;
}

/// The cut-off that the total time corresponds to: the inverse of time_for_cutoff.
double cutoff_of(double time, double unit) {
  return std::pow(time / unit, 0.25) / std::pow(time_for_cutoff(1), 0.25);
}

/// A remark if the default cut-off has smoothed the mesh strongly; else empty.
std::string remark_on_default_cutoff(const SmoothFigures& figures) {
  if (figures.cutoff > figures.diagonal / 2) {
    return fmt::format(
        "the cut-off {:.4g} is more than half of the mesh's diagonal {:.4g}, so that the whole "
        "shape is smoothed; a shorter --cutoff LENGTH keeps the shape",
        figures.cutoff, figures.diagonal);
  }
  constexpr double large_change = 0.01;
  constexpr double solid = 0.05;  // share of the volume of a ball of equal area; below: a sheet
  const double volume = std::abs(figures.before.volume);
  const double ball = std::pow(figures.before.area, 1.5) / (6 * std::sqrt(std::numbers::pi));
  const double change = std::abs(figures.after.volume) / volume - 1;
  if (volume > solid * ball && std::abs(change) > large_change) {
    return fmt::format(
        "the volume has changed by {:+.2g} %: the mesh has features that are shorter than the "
        "cut-off {:.4g}; --denoise removes noise only, and a shorter --cutoff LENGTH keeps longer "
        "features",
        100 * change, figures.cutoff);
  }
  return {};
}

/// If keeping creases leaves less error than the choice stored in `figures`, replaces the choice.
void resolve_creases(SmoothArguments& arguments, const Points& X, const Topology& topology,
                     const std::vector<std::uint8_t>& fixed, const FlowOptions& without,
                     const CutoffSearch& search, SmoothFigures& figures) {
  const FlowOptions options = crease_options(arguments, without);
  const auto creases = choose_creases(X, topology, fixed, options, *figures.choice, search);
  if (creases) {
    arguments.flow = options;
    arguments.flow.sharp_angle = creases->sharp_angle;
    figures.creases = {creases->sharp_angle, *figures.choice};
    figures.choice = creases->cutoff;
  }
}

/// A remark about the texture coordinates; empty if there is nothing to say.
std::string remark_on_texture(const SmoothArguments& arguments) {
  const FlowOptions& options = arguments.flow;
  if (!arguments.textured) {
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

BoundaryCondition boundary_condition(const std::string& name) {
  return name == "fixed"      ? BoundaryCondition::fixed
         : name == "position" ? BoundaryCondition::position
                              : BoundaryCondition::free;
}

}  // namespace

void check_outputs(const SmoothArguments& arguments) {
  check_reports(arguments.report,
                {{"", arguments.output.path},
                 {"--picture", arguments.picture.path},
                 {"--checkpoint", arguments.checkpoint}},
                arguments.output.write.overwrite);
}

OutputOptions checkpoint_of(const SmoothArguments& arguments) {
  OutputOptions checkpoint = arguments.output;
  checkpoint.path = arguments.checkpoint;
  checkpoint.write.format.clear();
  return checkpoint;
}

void set_relaxation(const SmoothArguments& arguments, FlowOptions& options) {
  const bool by_default = !bending_model(options.laplacian).evens_edges && !arguments.textured;
  options.relax = arguments.tangential == "relax" || (arguments.tangential.empty() && by_default);
  options.put_back_slides = arguments.tangential == "keep";
  options.relax_first = arguments.tangential != "none" && !options.put_back_slides;
}

void set_flow_options(const SmoothArguments& arguments, FlowOptions& options) {
  options.mass = arguments.mass.mass();
  options.mass_matrix = arguments.mass.name;
  options.metric = arguments.metric == "mass" ? Metric::mass : Metric::identity;
  options.guarded = !arguments.plain;
  set_relaxation(arguments, options);
  if (arguments.keep_sharp) {
    options.sharp_angle = radians(*arguments.keep_sharp);
  }
}

void set_scale(const SmoothArguments& arguments, const Points& X, const Topology& topology,
               const MeshParts& parts, FlowOptions& options, SmoothFigures& figures) {
  options.total_time = total_time(arguments, X, topology, parts);
  figures.diagonal = diagonal(X, parts);
  figures.cutoff =
      cutoff_of(options.total_time, time_in_flow_units(1, X, topology, arguments.flow, parts));
  if (arguments.max_move) {
    options.max_move = arguments.max_move->on(X, topology, parts);
  }
}

void resolve_cutoff(SmoothArguments& arguments, const Points& X, const Topology& topology,
                    const std::vector<std::uint8_t>& fixed, SmoothFigures& figures,
                    Progress& progress) {
  if (!arguments.cutoff_auto || std::find(fixed.begin(), fixed.end(), 0) == fixed.end()) {
    return;  // not requested, or no vertex can move
  }
  const Stopwatch watch(figures.seconds_choice);
  FlowOptions options = arguments.flow;
  set_scale(arguments, X, topology, MeshParts::one(), options, figures);
  const auto tell = [&](double cutoff) {
    progress.begin(fmt::format("try a cut-off of {:.1f} edges", cutoff / figures.mean_edge_length));
  };
  const CutoffSearch search{.largest = figures.diagonal / 2, .observer = tell};
  figures.choice = choose_cutoff(X, topology, fixed, options, search);
  if (arguments.finds_creases) {
    resolve_creases(arguments, X, topology, fixed, options, search, figures);
  }
  arguments.cutoff = Length{figures.choice->cutoff, Length::Unit::absolute};
}

void project_directions(SmoothArguments& arguments, const Points& X, const Topology& topology,
                        const std::vector<std::uint8_t>& fixed, const MeshParts& parts,
                        SmoothFigures& figures, Progress& progress) {
  const std::vector<double>& a = arguments.anisotropy;
  if (a.empty()) {
    return;
  }
  const auto laid_onto = [&](const Points& Y) {
    return material_directions(Y, topology, Vec3(a[0], a[1], a[2]), a[3]);
  };
  const Stopwatch watch(figures.seconds_directions);
  FlowOptions& flow = arguments.flow;
  FlowOptions options = flow;
  flow.material_directions = laid_onto(X);
  // Throws now, and not after a long flow, if the options are invalid.
  bending_model(flow.laplacian).create(topology, flow.energy_options());
  if (flow.steps == 0 || arguments.dry_run) {
    return;
  }
  progress.begin("lay directions");
  options.twicing = 0;
  set_scale(arguments, X, topology, parts, options, figures);
  Points smooth = X;
  willmore_flow(smooth, topology, fixed, options, {}, parts);
  flow.material_directions = laid_onto(smooth);
}

std::vector<std::uint8_t> held_by(const SmoothArguments& arguments, const Topology& topology,
                                  const std::vector<Index>& listed,
                                  const std::vector<std::uint8_t>& mask,
                                  const Eigen::VectorXd& weights) {
  auto fixed = fixed_vertices(topology, boundary_condition(arguments.boundary));
  for (const Index v : listed) {
    fixed[v] = 1;
  }
  for (std::size_t v = 0; v < mask.size(); ++v) {
    fixed[v] |= mask[v] ? 0 : 1;
  }
  for (Eigen::Index v = 0; v < weights.size(); ++v) {
    fixed[v] |= weights[v] > 0 ? 0 : 1;
  }
  return fixed;
}

void run_smoothing(const SmoothArguments& arguments, Points& X, const Topology& topology,
                   const std::vector<std::uint8_t>& fixed, const MeshParts& parts,
                   SmoothFigures& figures, Progress& progress) {
  FlowOptions options = arguments.flow;
  set_scale(arguments, X, topology, parts, options, figures);
  std::optional<PostponedEnd> postponed;
  if (!arguments.checkpoint.empty()) {
    postponed.emplace();
  }
  progress.begin_work("prepare");
  options.on_stage = [&progress](FlowStage stage) { progress.enter(stage); };
  const auto observe = [&](const StepRecord& step) {
    progress.advance(step, options.steps, options.total_time);
    return !parts.any(PostponedEnd::signal_number() != 0);
  };
  figures.flow = willmore_flow(X, topology, fixed, options, observe, parts);
  figures.total_time = options.total_time;
}

void measure_moves(const Points& before, const Points& after, SmoothFigures& figures) {
  if (before.rows() > 0) {
    const Eigen::VectorXd squared = (after - before).rowwise().squaredNorm();
    figures.largest_move = std::sqrt(squared.maxCoeff());
    figures.rms_move = std::sqrt(squared.mean());
  }
}

void print_smoothing(const SmoothArguments& arguments, const SmoothFigures& figures,
                     const std::string& output, const WriteReport& written, std::string_view by,
                     const Console& console, Report& report) {
  if (const std::string remark = remark_on_texture(arguments); !remark.empty()) {
    console.note(remark);
  }
  if (!arguments.cutoff && !arguments.time_step) {
    if (const std::string remark = remark_on_default_cutoff(figures); !remark.empty()) {
      console.note(remark);
    }
  }
  for (const std::string& note : written.notes) {
    console.note(note);
  }
  report.figures["input"] = arguments.input;
  report.figures["output"] = output;
  add_smooth_figures(figures, arguments.flow, report);
  report.figures["moved_vertices"] = written.moved_vertices;
  console.note(fmt::format("{} -> {}, {} of {} vertices moved{}", arguments.input, output,
                           written.moved_vertices, figures.vertices, by),
               smooth_table(figures, console.level() == Console::Level::verbose));
  if (const std::string remark = remark_on(figures, output, arguments); !remark.empty()) {
    console.warning(remark);
    report.warnings.push_back({remark});
  }
}

}  // namespace ibmfair::commands
