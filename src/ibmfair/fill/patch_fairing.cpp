#include "ibmfair/fill/patch_fairing.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "ibmfair/base/errors.h"
#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/mass_matrices.h"
#include "ibmfair/fill/linear_fairing.h"
#include "ibmfair/fill/refine.h"
#include "ibmfair/flow/steps/stationary_flow.h"
#include "ibmfair/flow/time_scale.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {
namespace {

constexpr double first_cutoff = 20;       // of the flow's first step, in mean edge lengths
constexpr double limit_growth = 1 << 24;  // of the time step; then a step is that of Gauss-Newton
constexpr double coarse_rim = 20;         // approximate number of rim edges at the coarsest level
constexpr double finest_level = 1 << 30;  // edge length of the coarsest level over that of the last
constexpr int most_late_refinements = 3;
// The patch is refined again if it has more too long edges than this, relative to its own vertices.
constexpr double late_share = 0.05;
constexpr int sweeps_at_start = 4;  // of relaxation
constexpr int linear_starts = 3;
// The largest move along a normal in the last step of a converged level, in edge lengths.
constexpr double small_move = 0.004;
constexpr double coarse_small_move = 0.02;  // the same if a finer level follows
constexpr double flat_energy = 1e-12;       // of a flat patch, at most; a sphere has 25

std::vector<std::uint8_t> fixed_vertices(const Patch& patch, const Topology& topology) {
  std::vector<std::uint8_t> fixed(patch.free.size());
  for (std::size_t v = 0; v < fixed.size(); ++v) {
    fixed[v] =
        patch.free[v] && topology.kind[v] == VertexKind::interior && !topology.defective[v] ? 0 : 1;
  }
  return fixed;
}

double mean_edge_length(const Patch& patch) {
  double sum = 0;
  for (Index t = 0; t < patch.net.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      sum += (patch.X.row(patch.net.start({t, i})) - patch.X.row(patch.net.end({t, i}))).norm();
    }
  }
  return sum / (3.0 * patch.net.size());
}

/// The edge length in which the cut-off of the first step is measured: that of the surrounding mesh
/// at the rim, or of the patch if it has no rim.
double first_length(const Patch& patch) {
  if (patch.rim.empty()) {
    return mean_edge_length(patch);
  }
  double sum = 0;
  for (const RimEdge& edge : patch.rim) {
    sum += patch.spacing[edge.a];
  }
  return sum / static_cast<double>(patch.rim.size());
}

/// The flow on the patch's present triangles.
class Stage {
 public:
  Stage(const Patch& patch, const FlowOptions& options, double h, double h_limit, bool normal_only)
      : topology_(build_topology(patch.X, all_triangles(patch))),
        fixed_(fixed_vertices(patch, topology_)),
        flow_(patch.X, topology_, fixed_, options, h, h_limit, normal_only) {}

  StationaryFlow& flow() { return flow_; }

 private:
  Topology topology_;
  std::vector<std::uint8_t> fixed_;
  StationaryFlow flow_;
};

class PatchFairing {
 public:
  PatchFairing(Patch& patch, const FairingOptions& options, const PatchBound& bound)
      : patch_(patch),
        options_(options),
        bound_(bound),
        flow_options_(options.flow_options()),
        h_(time_for_cutoff(first_cutoff * first_length(patch))),
        h_limit_(h_ * limit_growth) {
    flow_options_.solver = "multifrontal";  // near the limit only direct solves are accurate enough
    flow_options_.memory_limit = options.memory_limit;
  }

  /// Fairs one level. `triangles_follow`: the triangulation is adapted while the patch takes its
  /// shape. `finest`: no finer level follows.
  void run(bool triangles_follow, bool finest) {
    const double settled = finest ? small_move : coarse_small_move;
    rebuild();
    report_.converged = false;
    for (int step = 0; step < options_.most_steps && flow().advance(); ++step) {
      ++report_.steps;
      report_.last_move = flow().last_normal_move();
      if (bound_.is_exceeded(flow().X(), patch_.own_from)) {
        report_.ran_away = true;
        break;
      }
      const bool at_limit = flow().time_step() >= h_limit_;
      if (at_limit && report_.last_move < settled && gradient_ratio() < options_.tolerance) {
        report_.converged = true;
        break;
      }
      if (triangles_follow && !at_limit) {
        follow();
      }
    }
    conclude();
  }

  FairingReport& report() { return report_; }

 private:
  StationaryFlow& flow() { return stage_->flow(); }
  double gradient_ratio() { return start_ > 0 ? flow().normal_gradient() / start_ : 0; }

  /// Whether the patch is flat up to rounding errors. Its gradient consists of these errors and
  /// cannot fall.
  bool is_flat() const {
    const double length = first_length(patch_);  // without mass, the energy has unit length^2
    return report_.energy_after < flat_energy * (options_.mass ? 1 : length * length);
  }

  void rebuild() {
    enter_stage();
    if (report_.levels++ == 0) {
      start_ = flow().normal_gradient();
      report_.energy_before = flow().energy();
    }
  }

  void follow() {
    const Triangles before = patch_.net.triangles();
    patch_.X = flow().X();
    if (patch_.own_size() > 0) {
      even_out(patch_, 1);
    } else {
      relax(patch_, 0);
    }
    if (patch_.net.triangles() == before) {
      Points X = patch_.X;
      flow().move_to(X);
      return;
    }
    close_stage();
    enter_stage();
  }

  void enter_stage() {
    // If relaxation moves vertices within the surface, the flow moves them along normals only.
    const bool normal_only = patch_.own_size() > 0 || options_.relax;
    stage_ = std::make_unique<Stage>(patch_, flow_options_, h_, h_limit_, normal_only);
  }

  /// Takes over the time step of the present stage, and adds its effort to the report.
  void close_stage() {
    h_ = flow().time_step();
    const FlowReport& part = flow().report();
    FlowReport& all = report_.flow;
    all.unknowns = part.unknowns;
    all.add_effort(part);
  }

  void conclude() {
    patch_.X = flow().X();
    report_.energy_after = flow().energy();
    report_.gradient_ratio = gradient_ratio();
    // A patch without free vertices, or at a stationary point from the start, has converged.
    report_.converged = report_.converged || start_ == 0 || is_flat();
    close_stage();
    stage_.reset();
  }

  Patch& patch_;
  const FairingOptions& options_;
  const PatchBound bound_;
  FlowOptions flow_options_;
  FairingReport report_;
  double h_;
  const double h_limit_;
  double start_ = 0;  // the normal gradient before the first step
  std::unique_ptr<Stage> stage_;
};

}  // namespace

void FairingOptions::validate() const {
  ibmfair::mass_matrix(bending_model(laplacian), {mass, {}, mass_matrix});
  if (!(tolerance > 0) || most_steps < 1 || most_levels < 1) {
    throw BadOption(
        "the tolerance must be positive and there must be at least one step and one level");
  }
}

FlowOptions FairingOptions::flow_options() const {
  FlowOptions options;
  options.laplacian = laplacian;
  options.mass = mass;
  options.mass_matrix =
      mass_matrix.empty() ? std::string(area_mass(bending_model(laplacian)).name) : mass_matrix;
  return options;
}

FairingReport fair(Patch& patch, const FairingOptions& options) {
  PatchFairing fairing(patch, options, {});
  fairing.run(options.relax, true);
  return fairing.report();
}

namespace {

/// Moves the patch to the sphere, and refines it there. Returns what `refine` returns.
bool refine_on(const RimSphere& sphere, Patch& patch, double coarsening, Index most_vertices) {
  if (!lift_to(sphere, patch)) {
    return true;
  }
  const bool refined = refine(patch, {coarsening, true, most_vertices});
  even_out(patch, sweeps_at_start);
  for (Index v = patch.own_from; v < patch.size(); ++v) {
    const Vec3 ray = patch.X.row(v).transpose() - sphere.center;
    patch.X.row(v) = sphere.center + sphere.radius * ray.normalized();
  }
  return refined;
}

/// Fairs a tube linearly, each time with the lengths and angles of the previous result: straight
/// edges between its ends are much too short where the tube bends. Returns what `refine` returns.
bool start_linearly(Patch& patch, double coarsening, Index most_vertices) {
  bool refined = true;
  for (int i = 0; i < linear_starts && refined; ++i) {
    fair_linearly(patch);
    refined = refine(patch, {coarsening, true, most_vertices});
    even_out(patch, sweeps_at_start);
  }
  return refined;
}

/// Refines and fairs again a patch whose edges have become too long because it bulged out. If the
/// refined patch does not converge, the previous patch and report are kept.
void refine_late(Patch& patch, PatchFairing& fairing, Index most_vertices) {
  for (int i = 0; i < most_late_refinements && fairing.report().converged &&
                  count_long_edges(patch) > late_share * patch.own_size();
       ++i) {
    const Patch settled = patch;
    const FairingReport report = fairing.report();
    const bool refined = refine(patch, {1, true, most_vertices});
    if (refined) {
      fairing.run(false, true);
    }
    if (!refined || !fairing.report().converged) {
      patch = settled;
      fairing.report() = report;
      return;
    }
  }
}

}  // namespace

FairingReport refine_and_fair(Patch& patch, const FairingOptions& options,
                              const PatchLimits& limits, bool& refined) {
  PatchFairing fairing(patch, options, limits.bound);
  const double finer = std::clamp(edges_along_rim(patch) / coarse_rim, 1.0, finest_level);
  const int coarsest = std::min(static_cast<int>(std::log2(finer)), options.most_levels - 1);
  refined = true;
  for (int level = coarsest; level >= 0 && refined && !fairing.report().ran_away; --level) {
    const double coarsening = std::ldexp(1.0, level);
    refined = refine(patch, {coarsening, level < coarsest, limits.most_vertices});
    if (level == coarsest && limits.start) {
      refined = refined && refine_on(*limits.start, patch, coarsening, limits.most_vertices);
    }
    if (level == coarsest && limits.tube) {
      refined = refined && start_linearly(patch, coarsening, limits.most_vertices);
    }
    fairing.run(level == coarsest, level == 0 || !refined);
  }
  if (!fairing.report().ran_away) {
    refine_late(patch, fairing, limits.most_vertices);
  }
  return fairing.report();
}

}  // namespace ibmfair
