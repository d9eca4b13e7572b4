#include "commands/smooth_plan.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "commands/denoise_defaults.h"
#include "commands/smooth_defaults.h"
#include "ibmfair/base/angle.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/base/stopwatch.h"
#include "ibmfair/flow/fixed_vertices.h"
#include "ibmfair/flow/part_measures.h"
#include "ibmfair/flow/passes/meeting_lines.h"
#include "ibmfair/flow/settings/component_scales.h"
#include "ibmfair/flow/settings/crease_choice.h"
#include "ibmfair/flow/settings/laplacian_choice.h"
#include "ibmfair/flow/settings/level_steps.h"
#include "ibmfair/flow/settings/no_noise.h"
#include "ibmfair/flow/settings/steps_choice.h"
#include "ibmfair/flow/settings/thin_walls.h"
#include "ibmfair/flow/time_scale.h"
#include "ibmfair/flow/tuning.h"

namespace ibmfair::commands {
namespace {

BoundaryCondition boundary_condition(const std::string& name) {
  return name == "fixed"      ? BoundaryCondition::fixed
         : name == "position" ? BoundaryCondition::position
                              : BoundaryCondition::free;  // "free" and "fair"
}

class Planner {
 public:
  Planner(const SmoothArguments& arguments, const SmoothInput& input, Progress& progress)
      : arguments_(arguments), input_(input), progress_(progress) {
    plan_.textured = input.textured;
    plan_.mean_edge_length = mean_edge_length(input.X, input.topology, input.parts);
    set_flow_options();
    plan_.fixed = fixed_where(boundary_condition(arguments_.boundary));
    if (input.parts.is_whole() && !arguments.plain) {
      find_lines();
    }
  }

  SmoothPlan plan() {
    if (plan_.flow.steps > 0) {
      if (arguments_.denoise && !arguments_.max_move && input_.parts.is_whole()) {
        find_outliers();
      }
      if (arguments_.denoise && arguments_.weights.empty() && input_.parts.is_whole()) {
        plan_.flow.cutoff_factor = component_scales(X(), input_.topology);
        plan_.scales_components = plan_.flow.cutoff_factor.size() > 0;
      }
      set_scale();
      const auto& fixed = plan_.fixed;
      if (arguments_.cutoff_auto && std::find(fixed.begin(), fixed.end(), 0) != fixed.end()) {
        choose();
        if (plan_.flow.steps > 0) {
          set_scale();
        }
      }
    }
    if (plan_.flow.steps > 0) {  // none if --denoise has found no noise
      find_thin_walls();
    }
    if (!arguments_.anisotropy.empty()) {
      project_directions();
    }
    const bool steps = plan_.choice && plan_.choice->kind == NoiseKind::steps;
    if (plan_.choice && !steps) {
      plan_.lines.clear();  // their corners cannot be told from noise
    }
    const bool keeps_rims = arguments_.chooses_boundary && steps;
    if (arguments_.boundary == "fair" && plan_.flow.steps > 0 && !keeps_rims) {
      plan_rims();
    }
    return std::move(plan_);
  }

 private:
  /// The mesh without its outliers.
  const Points& X() const { return plan_.outliers.empty() ? input_.X : without_outliers_; }

  void set_flow_options() {
    FlowOptions& flow = plan_.flow;
    flow = arguments_.flow;
    set_time_steps(flow);
    flow.mass = arguments_.mass.mass();
    flow.mass_matrix = arguments_.mass.name;
    flow.metric = arguments_.metric == "mass" ? Metric::mass : Metric::identity;
    flow.guarded = !arguments_.plain;
    flow.first_stage = arguments_.first_stage == "normals" ? FirstStage::normals : FirstStage::flow;
    set_relaxation(flow);
    if (arguments_.keep_sharp) {
      flow.sharp_angle = radians(*arguments_.keep_sharp);
    }
    // With bounded moves the volume cannot be kept exactly.
    const Topology& topology = input_.topology;
    flow.keep_volume |= arguments_.denoise && topology.boundary_loops.empty() &&
                        topology.orientable && !arguments_.max_move;
    flow.cutoff_factor = input_.weights;
    flow.spontaneous_curvature = input_.h0;
    if (input_.make_solver) {
      flow.solver = "auto";
      flow.make_solver = input_.make_solver;
    }
  }

  void set_time_steps(FlowOptions& flow) const {
    const SmoothArguments& a = arguments_;
    const bool named = a.steps || a.time_step || a.cutoff_auto || a.plain;
    const bool badly_scaled = a.keep_sharp || !a.weights.empty() || !a.mass.mass();
    const bool far = a.cutoff && length(*a.cutoff) > longest_quick_edges * plan_.mean_edge_length;
    const bool quick = !named && !badly_scaled && !far && flow.twicing == 0;
    const StepDefaults& defaults = quick ? quick_defaults : reference_defaults;
    flow.steps = a.steps.value_or(defaults.steps);
    flow.solver_tolerance = a.solver_tolerance.value_or(defaults.solver_tolerance);
  }

  /// Without --tangential, vertices slide within the surface, except on a textured mesh, where the
  /// texture would shift.
  void set_relaxation(FlowOptions& flow) const {
    const std::string& name = arguments_.tangential;
    const bool by_default = !bending_model(flow.laplacian).evens_edges && !input_.textured;
    flow.relax = name == "relax" || (name.empty() && by_default);
    flow.put_back_slides = name == "keep";
    flow.relax_first = name != "none" && !flow.put_back_slides;
  }

  /// Flags of the vertices that do not move under this condition at open boundaries.
  std::vector<std::uint8_t> fixed_where(BoundaryCondition condition) const {
    std::vector<std::uint8_t> fixed = fixed_vertices(input_.topology, condition);
    for (const Index v : input_.listed) {
      fixed[v] = 1;
    }
    for (std::size_t v = 0; v < input_.mask.size(); ++v) {
      fixed[v] |= input_.mask[v] ? 0 : 1;
    }
    for (Eigen::Index v = 0; v < input_.weights.size(); ++v) {
      fixed[v] |= input_.weights[v] > 0 ? 0 : 1;
    }
    input_.parts.refresh(fixed);  // the border of a piece is no boundary of the mesh
    return fixed;
  }

  /// The fixed vertices for choosing a cut-off. The noise at a rim is removed along the rim first,
  /// and what is left of it would be taken for detail. Noise is judged on components of long edges
  /// only: on others it has another strength.
  std::vector<std::uint8_t> fixed_for_choice() const {
    std::vector<std::uint8_t> fixed = plan_.fixed;
    if (arguments_.boundary == "fair") {
      fixed = fixed_where(BoundaryCondition::fixed);
    }
    for (std::size_t v = 0; plan_.scales_components && v < fixed.size(); ++v) {
      fixed[v] |= plan_.flow.cutoff_factor[static_cast<Eigen::Index>(v)] < 1 ? 1 : 0;
    }
    return std::ranges::count(fixed, 0) > 0 ? fixed : plan_.fixed;
  }

  /// If the noise is known, rims are faired as far as it explains.
  void plan_rims() {
    plan_.rims = RimFairing{.cutoff = plan_.cutoff,
                            .twicing = std::max(1, plan_.flow.twicing),
                            .noise = plan_.choice ? plan_.choice->noise.deviation : 0,
                            .max_move = plan_.flow.max_move};
    plan_.restores_rims =
        plan_.rims->noise > 0 && plan_.choice->noise.is_white() && plan_.may_restore();
  }

  /// Finds the lines at which sheets meet, and the factors of the cut-off there. Their vertices are
  /// among the fixed ones as far as the flow of the sheets goes.
  void find_lines() {
    plan_.lines = find_meeting_lines(input_.topology);
    if (plan_.lines.empty()) {
      return;
    }
    plan_.line_factor = input_.weights.size() > 0
                            ? input_.weights.cwiseMax(0)
                            : Eigen::VectorXd(Eigen::VectorXd::Ones(X().rows()));
    for (const Index v : input_.listed) {
      plan_.line_factor[v] = 0;
    }
    for (std::size_t v = 0; v < input_.mask.size(); ++v) {
      plan_.line_factor[static_cast<Eigen::Index>(v)] *= input_.mask[v] ? 1 : 0;
    }
  }

  /// The walls of a mesh are sampled for a remark on their thickness. Where the amount of smoothing
  /// is not estimated from noise, the rims of thin walls are fixed.
  void find_thin_walls() {
    if (!input_.parts.is_whole()) {
      return;
    }
    const Stopwatch watch(plan_.seconds_walls);
    plan_.wall_sample = sample_walls(X(), input_.topology, plan_.cutoff);
    if (arguments_.cutoff_auto || arguments_.time_step || arguments_.plain) {
      return;
    }
    plan_.thin = thin_walls(X(), input_.topology, plan_.wall_sample);
    for (std::size_t v = 0; v < plan_.thin.rims.size(); ++v) {
      plan_.fixed[v] |= plan_.thin.rims[v];
    }
  }

  double in_flow_units(double time) const {
    return time_in_flow_units(time, X(), input_.topology, plan_.flow, input_.parts);
  }

  double length(const Length& length) const {
    return length.on(X(), input_.topology, input_.parts);
  }

  /// The total time in the flow's unit: the number of steps times --time-step, or the time for the
  /// cut-off.
  double total_time() const {
    const int steps = plan_.flow.steps;
    if (arguments_.time_step) {
      return *arguments_.time_step * steps;
    }
    const double cutoff = plan_.choice
                              ? plan_.choice->cutoff
                              : length(arguments_.cutoff.value_or(Length{default_cutoff_edges}));
    // More --steps without a --cutoff smooth more.
    const bool grows = arguments_.steps && !plan_.choice && !arguments_.cutoff;
    const double shares = grows ? reference_defaults.steps : steps;
    const double total = in_flow_units(time_for_cutoff(cutoff)) / shares * steps;
    if (plan_.mean_edge_length == 0) {
      throw BadMesh("all edges have the length 0, so that there is nothing to smooth");
    }
    if (!(total > 0 && std::isfinite(total))) {
      throw BadMesh(
          fmt::format("edges of mean length {:.4g} are too {} to compute with; scale the "
                      "mesh",
                      plan_.mean_edge_length, total > 0 ? "long" : "short"));
    }
    return total;
  }

  void find_outliers() {
    plan_.outliers = ibmfair::find_outliers(X(), input_.topology, plan_.fixed);
    if (!plan_.outliers.empty()) {
      without_outliers_ = input_.X;
      plan_.outliers.move_in(without_outliers_);
      plan_.mean_edge_length = mean_edge_length(X(), input_.topology, input_.parts);
    }
  }

  void set_scale() {
    plan_.flow.total_time = total_time();
    plan_.diagonal = diagonal(X(), input_.parts);
    plan_.cutoff = std::pow(plan_.flow.total_time / in_flow_units(1), 0.25) /
                   std::pow(time_for_cutoff(1), 0.25);
    if (arguments_.max_move) {
      plan_.flow.max_move = length(*arguments_.max_move);
    }
  }

  /// Chooses the cut-off, and with --denoise whether creases are kept.
  void choose() {
    const Stopwatch watch(plan_.seconds_choice);
    const auto tell = [&](double cutoff) {
      progress_.begin(
          fmt::format("try a cut-off of {:.1f} edges", cutoff / plan_.mean_edge_length));
    };
    const CutoffSearch search{.largest = plan_.diagonal / 2, .observer = tell};
    if (const double step = arguments_.finds_creases ? level_step(X(), input_.topology) : 0;
        step > 0) {
      smooth_steps(step, search);
      return;
    }
    const std::vector<std::uint8_t> fixed = fixed_for_choice();
    plan_.choice = choose_cutoff(X(), input_.topology, fixed, plan_.flow, search);
    if (arguments_.denoise && is_without_noise(X(), input_.topology, fixed, *plan_.choice)) {
      leave_as_it_is();
      return;
    }
    if (!arguments_.finds_creases) {
      return;
    }
    FlowOptions options = plan_.flow;
    keep_creases(options);
    set_relaxation(options);
    const auto find_creases = [&] {
      return choose_creases(X(), input_.topology, fixed, options, *plan_.choice, search);
    };
    CreaseFindings found = find_creases();
    if (found.noise_is_mixed) {
      plan_.choice = choose_cutoff_for(plan_.choice->mixed_noise, X(), input_.topology, fixed,
                                       plan_.flow, search);
      found = find_creases();
    }
    if (const auto& creases = found.choice) {
      options.sharp_angle = creases->sharp_angle;
      plan_.flow = options;
      plan_.creases = {creases->sharp_angle, *plan_.choice};
      plan_.choice = creases->cutoff;
    } else if (plan_.choice->kind == NoiseKind::independent) {
      choose_without_creases(fixed, search);
    }
  }

  void choose_without_creases(const std::vector<std::uint8_t>& fixed, const CutoffSearch& search) {
    FlowOptions options = plan_.flow;
    suit_round_shapes(options);
    set_relaxation(options);
    if (const auto choice = choose_laplacian(X(), input_.topology, fixed, plan_.flow, options,
                                             *plan_.choice, search)) {
      plan_.flow = options;
      plan_.choice = choice;
    }
  }

  void leave_as_it_is() {
    plan_.choice->kind = NoiseKind::none;
    plan_.choice->cutoff = plan_.cutoff = 0;
    plan_.flow.steps = 0;
    plan_.flow.total_time = 0;
  }

  /// Smooths by the default cut-off, or by less if that would move the vertices further than the
  /// steps explain. The errors of coordinates on levels are too regular to estimate what a cut-off
  /// leaves, and hinges at steps would be taken for creases.
  void smooth_steps(double step, const CutoffSearch& search) {
    if (arguments_.chooses_steps) {
      plan_.flow.steps = reference_defaults.steps;
    }
    if (arguments_.chooses_boundary) {
      plan_.fixed = fixed_where(BoundaryCondition::fixed);
    }
    keep_creases(plan_.flow);
    set_relaxation(plan_.flow);
    const StepsChoice chosen =
        choose_for_steps(X(), input_.topology, plan_.fixed, plan_.flow, step,
                         default_cutoff_edges * plan_.mean_edge_length, search);
    plan_.choice.emplace();
    plan_.choice->kind = NoiseKind::steps;
    plan_.choice->noise.deviation =
        step / std::sqrt(12.0);  // of numbers rounded to multiples of the step
    plan_.choice->cutoff = chosen.cutoff;
    if (chosen.sharp_angle > 0) {
      plan_.flow.sharp_angle = chosen.sharp_angle;
      plan_.creases = {chosen.sharp_angle, *plan_.choice};
    }
  }

  void project_directions() {
    const std::vector<double>& a = arguments_.anisotropy;
    const auto directions_on = [&](const Points& Y) {
      return material_directions(Y, input_.topology, Vec3(a[0], a[1], a[2]), a[3]);
    };
    const Stopwatch watch(plan_.seconds_directions);
    FlowOptions& flow = plan_.flow;
    FlowOptions without = flow;
    flow.material_directions = directions_on(X());
    // Throws now, and not after a long flow, if the options are invalid.
    bending_model(flow.laplacian).create(input_.topology, flow.energy_options());
    if (flow.steps == 0 || arguments_.dry_run) {
      return;
    }
    progress_.begin("project directions");
    without.twicing = 0;
    Points smooth = X();
    willmore_flow(smooth, input_.topology, plan_.fixed, without, {}, input_.parts);
    flow.material_directions = directions_on(smooth);
  }

  const SmoothArguments& arguments_;
  const SmoothInput& input_;
  Progress& progress_;
  SmoothPlan plan_;
  Points without_outliers_;  // #V x 3, if there are outliers
};

}  // namespace

SmoothPlan plan_smoothing(const SmoothArguments& arguments, const SmoothInput& input,
                          Progress& progress) {
  return Planner(arguments, input, progress).plan();
}

}  // namespace ibmfair::commands
