#include "commands/smooth_remarks.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "commands/signals.h"
#include "commands/value_list.h"
#include "ibmfair/base/angle.h"
#include "ibmfair/base/quantile.h"
#include "ibmfair/flow/tuning.h"

namespace ibmfair::commands {
namespace {

/// A remark about options that refer to the original mesh, but that a continued run would apply to
/// the mesh written here.
std::string_view options_that_restart(const FlowOptions& options) {
  const bool bounded = std::isfinite(options.max_move), put_back = options.twicing > 0;
  return bounded && put_back ? "; --max-move and --twicing then refer to that mesh"
         : bounded           ? "; --max-move then refers to that mesh"
         : put_back          ? "; --twicing then refers to that mesh"
                             : "";
}

/// The options that continue the flow, with time steps of about the same length.
std::string how_to_continue(const SmoothResult& result) {
  const double left = result.plan.flow.total_time - result.flow.time_reached;
  const double share = left / result.plan.flow.total_time;
  if (!(share > 1e-9)) {
    return "the flow was complete";
  }
  const double count = std::max(1.0, std::ceil(share * result.plan.flow.steps - 1e-6));
  return fmt::format(
      "to continue, smooth it with --steps {:.0f} --time-step {} and without --cutoff{}", count,
      left / count, options_that_restart(result.plan.flow));
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

/// A remark if components of short edges are smoothed less; else empty.
std::string remark_on_components(const SmoothPlan& plan) {
  return plan.scales_components
             ? "some components have much shorter edges than others: noise is looked for on the "
               "others, and on these the cut-off is shorter in proportion (in files of their own, "
               "each has its own choice)"
             : "";
}

/// A remark if triangles lie side by side without sharing vertices; else empty.
std::string remark_on_coincident_vertices(const SmoothResult& result) {
  constexpr std::int64_t least_share = 10;  // one of so many vertices on open boundaries
  if (result.coincident * least_share < result.boundary_vertices || result.coincident == 0) {
    return {};
  }
  return fmt::format(
      "{} of {} vertices on open boundaries coincide with others: triangles lie side by side "
      "without sharing their edges, and these boundaries stay fixed or come apart; --weld merges "
      "such vertices",
      result.coincident, result.boundary_vertices);
}

/// A remark if the default cut-off is longer than the mesh is large; else empty.
std::string remark_on_default_cutoff(const SmoothResult& result) {
  if (result.plan.cutoff <= result.plan.diagonal / 2) {
    return {};
  }
  return fmt::format(
      "the cut-off {:.4g} is more than half of the mesh's diagonal {:.4g}, so that the whole shape "
      "is smoothed; a shorter --cutoff LENGTH keeps the shape",
      result.plan.cutoff, result.plan.diagonal);
}

/// Why the volume has changed: 2 V / A is the thickness of a plate, and at most 2/3 of the radius
/// of a solid.
std::string cause_of_volume_change(const MeshStatistics& before, double cutoff) {
  const double thickness = 2 * std::abs(before.volume) / before.area;
  return thickness < cutoff / 4
             ? fmt::format(
                   "walls that are thinner than the cut-off {:.4g} swell or shrink (here "
                   "the mean thickness is about {:.2g})",
                   cutoff, thickness)
             : fmt::format("the mesh has features that are shorter than the cut-off {:.4g}",
                           cutoff);
}

/// What keeps the volume and the walls better.
std::string remedies_for_volume(const SmoothArguments& arguments, const FlowOptions& options) {
  std::vector<std::string> remedies{"a shorter --cutoff LENGTH"};
  if (!std::isfinite(options.max_move) && !options.keep_volume) {
    remedies.emplace_back("--keep-volume");
  }
  if (options.twicing == 0) {
    remedies.emplace_back("--twicing 1");
  }
  if (!arguments.denoise) {
    remedies.emplace_back("--denoise (which removes noise only)");
  }
  return fmt::format("{}", fmt::join(remedies, ", or "));
}

/// A remark about noise that is not independent from vertex to vertex, and what is done about it;
/// empty if there is nothing to say.
std::string remark_on_noise(const SmoothPlan& plan) {
  if (!plan.choice) {
    return {};
  }
  switch (plan.choice->kind) {
    case NoiseKind::none:
      return fmt::format(
          "no noise was found: {} written as read (noise that hardly differs between neighbouring "
          "vertices cannot be told from detail; --cutoff LENGTH smooths it)",
          plan.outliers.empty() ? "the mesh is" : "all other vertices are");
    case NoiseKind::outliers:
      return "the noise has outliers: a few vertices are much farther off than the others";
    case NoiseKind::correlated:
      return fmt::format(
          "the noise of vertices up to about {:.0f} edges apart is correlated, so that the error "
          "left cannot be estimated; its long waves cannot be told from detail, and stay{} (a "
          "longer --cutoff LENGTH removes more)",
          plan.choice->noise.reach(),
          plan.flow.sharp_angle > 0 ? fmt::format(", as do edges of more than {:.0f} degrees",
                                                  degrees(plan.flow.sharp_angle))
                                    : "");
    case NoiseKind::steps:
      return fmt::format(
          "the vertices are on few levels, like those of voxels or of rounded heights, so that the "
          "error left cannot be estimated; the steps between the levels are smoothed {} (--cutoff "
          "LENGTH overrides this)",
          plan.creases
              ? "as far as steps explain the moves: longer cut-offs, or not keeping edges, "
                "would remove parts of the shape"
              : "by the default cut-off");
    case NoiseKind::independent:
      break;
  }
  return {};
}

/// A remark if a mesh has so few vertices that its noise is only guessed; else empty. Of shapes
/// without noise that have 30 to 500 vertices, several are taken for noisy.
std::string remark_on_few_vertices(const SmoothResult& result) {
  constexpr Index few = 1000;
  const auto& choice = result.plan.choice;
  if (!choice || choice->kind == NoiseKind::none || choice->kind == NoiseKind::steps ||
      result.flow.unknowns >= few || result.flow.unknowns == 0) {
    return {};
  }
  return fmt::format(
      "with only {}, noise can hardly be told from the shape: compare the result with the input "
      "(where the mesh has no noise, leave it as it is, or choose a --cutoff LENGTH)",
      counted(result.flow.unknowns, "vertex", "vertices"));
}

/// A remark about outliers; empty if there are none.
std::string remark_on_outliers(const SmoothPlan& plan) {
  if (plan.outliers.empty()) {
    return {};
  }
  const auto count = std::ssize(plan.outliers.vertices);
  return fmt::format(
      "{} far off the surface of {} neighbours, and {} moved onto it before all else (where this "
      "is part of the shape, --fix FILE keeps vertices; the report lists their numbers)",
      counted(count, "vertex is", "vertices are"), count == 1 ? "its" : "their",
      count == 1 ? "was" : "were");
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

/// The median thickness of the sampled walls.
double median_thickness(const WallSample& sample) {
  std::vector<double> thickness;
  for (const Wall& wall : sample.walls) {
    if (wall.exists()) {
      thickness.push_back(wall.thickness);
    }
  }
  if (thickness.empty()) {
    return 0;
  }
  return median(thickness);
}

/// A remark about rims of thin walls, which stay; empty if there are none.
std::string remark_on_thin_walls(const SmoothPlan& plan) {
  const auto rims = std::ranges::count(plan.thin.rims, 1);
  if (rims == 0) {
    return {};
  }
  const double thickness = median_thickness(plan.wall_sample);
  return fmt::format(
      "the mesh has walls that are thinner than two edges (about {:.3g}): {} at their rims and "
      "next to them stay fixed, as bending would blow the walls up there; a --cutoff that is "
      "shorter "
      "than the walls are thick lets them move",
      thickness, counted(rims, "vertex", "vertices"));
}

/// A remark about the lines in which sheets meet; empty if there are none.
std::string remark_on_lines(const SmoothPlan& plan) {
  if (plan.lines.empty() || plan.flow.steps == 0) {
    return {};
  }
  std::size_t lines = 0, vertices = 0;
  for (const MeetingLine& line : plan.lines) {
    const std::size_t ends = line.closed ? 0 : 2;  // which stay
    if (line.vertices.size() > ends) {
      ++lines;
      vertices += line.vertices.size() - ends;
    }
  }
  if (lines == 0) {
    return {};
  }
  return fmt::format("{} in which three or more sheets meet, with {}, {}",
                     counted(static_cast<long long>(lines), "line", "lines"),
                     counted(static_cast<long long>(vertices), "vertex", "vertices"),
                     lines == 1 ? "was smoothed as a curve" : "were smoothed as curves");
}

/// Why no vertex can move where no option is the cause, with what helps; empty otherwise.
std::string cause_of_standstill(const SmoothResult& result) {
  if (result.duplicates > 0 && 2 * result.duplicates >= result.triangles) {
    return fmt::format(
        ": {} of {} triangles have the same vertices as another, and the vertices of such "
        "triangles are fixed; ibmfair has no option that removes them (delete one triangle of each "
        "pair in a mesh editor first, or leave out --weld if that has laid them over each other)",
        result.duplicates, result.triangles);
  }
  if (std::ranges::count(result.plan.thin.rims, 1) > 0) {
    return ": all lie at rims of thin walls or are fixed by an option (see above)";
  }
  return "";
}

/// The warning if no vertex may move, with what fixes the vertices.
std::string warning_on_fixed(const SmoothArguments& arguments, const SmoothResult& result) {
  const std::string cause = cause_of_standstill(result);
  if (!cause.empty()) {
    return "no vertex is free to move, and the mesh is written as it was read" + cause;
  }
  std::vector<std::string> causes;
  if (result.has_rims && (arguments.boundary == "fixed" || arguments.boundary == "position")) {
    causes.emplace_back("open boundaries (--boundary free lets them move)");
  }
  if (result.defective) {
    causes.emplace_back("defects of the mesh");
  }
  for (const auto& [option, value] : {std::pair{"--mask", arguments.mask},
                                      {"--fix", arguments.fix_file},
                                      {"--weights", arguments.weights}}) {
    if (!value.empty()) {
      causes.emplace_back(option);
    }
  }
  return fmt::format(
      "no vertex is free to move, and the mesh is written as it was read{}",
      causes.empty() ? "" : fmt::format("; vertices are fixed by {}", fmt::join(causes, ", ")));
}

}  // namespace

std::vector<std::string> notes_on(const SmoothArguments& arguments, const SmoothResult& result) {
  std::vector<std::string> notes{remark_on_texture(arguments, result.plan),
                                 remark_on_outliers(result.plan),
                                 remark_on_noise(result.plan),
                                 remark_on_few_vertices(result),
                                 remark_on_coincident_vertices(result),
                                 remark_on_components(result.plan),
                                 remark_on_thin_walls(result.plan),
                                 remark_on_lines(result.plan)};
  if (arguments.first_stage == "normals" && !arguments.denoise && !arguments.keep_sharp) {
    notes.emplace_back("--first-stage has no effect without --keep-sharp ANGLE");
  }
  if (!arguments.cutoff && !result.plan.choice && !arguments.time_step) {
    notes.push_back(remark_on_default_cutoff(result));
  }
  std::erase(notes, "");
  return notes;
}

std::string warning_on_volume(const SmoothArguments& arguments, const SmoothResult& result) {
  constexpr double large_change = 0.01;
  constexpr double rounding = 1e-9;  // of the volume of a cube of this area
  const double before = result.before.volume, after = result.after.volume;
  if (result.has_rims || !(std::abs(before) > rounding * std::pow(result.before.area, 1.5)) ||
      !(std::abs(after / before - 1) > large_change)) {
    return {};
  }
  return fmt::format("the volume has changed from {:.4g} to {:.4g} ({}): {}; what helps: {}",
                     before, after, change_text(before, after),
                     cause_of_volume_change(result.before, result.plan.cutoff),
                     remedies_for_volume(arguments, result.plan.flow));
}

std::string warning_on_walls(const SmoothArguments& arguments, const SmoothResult& result) {
  constexpr double large_change = 0.1;
  const bool looked = !arguments.cutoff_auto && !arguments.time_step && !arguments.plain;
  const bool has_none = looked && result.plan.thin.walls.empty();
  if (has_none || !(std::abs(result.thickening - 1) > large_change) ||
      !warning_on_volume(arguments, result).empty()) {
    return {};
  }
  return fmt::format(
      "walls thinner than two edges have changed their thickness ({}, the median): they are "
      "shorter across than the cut-off {:.4g}; what helps: {}",
      change_text(1, result.thickening), result.plan.cutoff,
      remedies_for_volume(arguments, result.plan.flow));
}

std::string warning_on_end(const SmoothArguments& arguments, const SmoothResult& result,
                           const std::string& output) {
  switch (result.flow.status) {
    case FlowStatus::completed:
      if (result.plan.flow.steps > 0 && result.flow.unknowns == 0 && result.largest_move == 0) {
        return warning_on_fixed(arguments, result);
      }
      return result.flow.twicings < result.plan.flow.twicing && result.plan.flow.steps > 0
                 ? fmt::format(
                       "--twicing: the removed part could be added back only {} of {} times",
                       result.flow.twicings, result.plan.flow.twicing)
                 : "";
    case FlowStatus::interrupted:
      return fmt::format("interrupted; {} the mesh as it is now: {}",
                         output.empty() ? "this is" : output + " holds", how_to_continue(result));
    case FlowStatus::stalled:
      return is_nearly_done(result)
                 ? ""
                 : fmt::format(
                       "the flow stalled: the mesh that was written is smoothed up to a wavelength "
                       "of {:.4g} instead of {:.4g}",
                       length_reached(result), result.plan.cutoff);
    case FlowStatus::diverged:
      return "the flow diverged, and the last finite mesh was written; take smaller steps (a "
             "larger number of --steps, or a shorter --cutoff LENGTH), or leave out --plain";
  }
  return {};
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
