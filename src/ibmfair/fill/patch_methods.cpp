#include "ibmfair/fill/patch_methods.h"

namespace ibmfair {
namespace {

// The largest roughness at which curvatures say more about the surface than about its roughness,
// and the largest likeness: neighbours are more alike only beside a crease or a step. Chosen on
// holes in models and in the originals of benchmarks of denoising (tools/fill_table --cut).
constexpr double most_rough_with_curvature = 0.1;
constexpr double most_alike_with_curvature = 0.86;

bool has_curvature_to_continue(const RimSurroundings& surroundings) {
  return surroundings.kind == SurroundingsKind::shaped &&
         surroundings.roughness < most_rough_with_curvature &&
         surroundings.likeness < most_alike_with_curvature && !surroundings.has_creases &&
         !surroundings.has_planes;
}

constexpr int repetitions = 2;  // of linear fairing; more change the shape by less than 1 %

PatchMethod linear_fairing() {
  return {"linear fairing", PatchKind::linear};
}

std::vector<PatchMethod> fairing_methods(const FillOptions& options) {
  const FairingOptions& asked = options.fairing;
  const std::string smoothed = " with smoothed directions at the rim";
  const PatchMethod first{asked.laplacian + (options.smooth_directions ? smoothed : ""),
                          PatchKind::stationary, asked, options.smooth_directions};
  std::vector<PatchMethod> methods;
  if (options.continue_curvature) {
    methods.push_back(first);
    methods.back().name += " with continued curvature";
    methods.back().continue_curvature = true;
  }
  methods.push_back(first);
  // At a rim with a sharp tip, the few triangles of the coarsest level cannot follow the rim.
  if (options.refine && asked.most_levels > 1) {
    methods.push_back(first);
    methods.back().name += " at the finest level only";
    methods.back().fairing.most_levels = 1;
  }
  methods.push_back(first);
  FairingOptions& other = methods.back().fairing;
  other.laplacian = asked.laplacian == "crouzeix-raviart" ? "lagrange" : "crouzeix-raviart";
  other.mass_matrix.clear();
  methods.back().name = other.laplacian;
  methods.back().smooth_directions = false;
  methods.push_back(first);
  methods.back().smooth_directions = !options.smooth_directions;
  methods.back().name = asked.laplacian + (options.smooth_directions ? "" : smoothed);
  methods.push_back(linear_fairing());
  return methods;
}

/// The methods that yield what `options` ask for, and those that come near it.
std::vector<PatchMethod> methods_for_continuity(const FillOptions& options) {
  switch (options.continuity) {
    case Continuity::positions:
      return {{"least area", PatchKind::least_area}};
    case Continuity::tangents:
      return {{.name = "repeated linear fairing",
               .kind = PatchKind::linear,
               .repetitions = repetitions},
              linear_fairing()};
    case Continuity::curvature:
      break;
  }
  return fairing_methods(options);
}

}  // namespace

FillOptions options_for(const RimSurroundings& surroundings, FillOptions options) {
  const bool shaped = surroundings.kind == SurroundingsKind::shaped;
  const bool fixed = options.rim_smooth == 0;
  options.continue_curvature = fixed && has_curvature_to_continue(surroundings);
  options.fairing.laplacian =
      shaped && !options.continue_curvature ? "crouzeix-raviart" : "intrinsic-delaunay";
  options.fairing.mass_matrix.clear();
  options.smooth_directions = surroundings.kind == SurroundingsKind::noisy && fixed;
  return options;
}

std::vector<PatchMethod> patch_methods(const FillOptions& options) {
  std::vector<PatchMethod> methods;
  if (options.fair) {
    methods = methods_for_continuity(options);
  }
  if (options.refine) {
    methods.push_back({"no fairing", PatchKind::unfaired});
  }
  methods.push_back({"no refinement", PatchKind::plain});
  return methods;
}

}  // namespace ibmfair
