#include "ibmfair/fill/continued_creases.h"

#include <algorithm>
#include <cmath>

#include "ibmfair/base/angle.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/fill/linear_fairing.h"
#include "ibmfair/fill/patch_audit.h"
#include "ibmfair/fill/patch_methods.h"
#include "ibmfair/fill/refine.h"
#include "ibmfair/fill/split_hole.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

constexpr double corner_reach = 2;    // of corners, in radii of the rim
constexpr double flat_height = 0.01;  // of a flat rim, in mean edge lengths

/// The loops of a rim, each in order.
std::vector<std::vector<RimEdge>> loops_of(const std::vector<RimEdge>& rim) {
  std::vector<std::vector<RimEdge>> loops;
  for (const RimEdge& edge : rim) {
    if (loops.empty() || loops.back().front().a == loops.back().back().b) {
      loops.emplace_back();
    }
    loops.back().push_back(edge);
  }
  return loops;
}

/// What a rim encloses.
struct RimExtent {
  Vec3 middle = Vec3::Zero(), normal = Vec3::Zero();
  double radius = 0, height = 0;  // the largest distances from the middle, and from its plane
  double spacing = 0;             // mean edge length

  explicit RimExtent(const Patch& plain) {
    const auto count = static_cast<double>(plain.rim.size());
    for (const RimEdge& edge : plain.rim) {
      middle += plain.X.row(edge.a) / count;
      spacing += plain.spacing[edge.a] / count;
    }
    Vec3 area = Vec3::Zero();
    for (const RimEdge& edge : plain.rim) {
      const Vec3 a = plain.X.row(edge.a), b = plain.X.row(edge.b);
      area += (a - middle).cross(b - middle);
      radius = std::max(radius, (a - middle).norm());
    }
    normal = area.normalized();
    for (const RimEdge& edge : plain.rim) {
      height = std::max(height, std::abs((plain.X.row(edge.a).transpose() - middle).dot(normal)));
    }
  }
};

/// Whether the rim lies in a plane from which all triangles of the mesh at the rim turn away by
/// more than `angle`, as where one face of a box is missing.
bool borders_flat_face(const Points& X, const Topology& topology, const Patch& plain,
                       const RimExtent& extent, double angle) {
  return extent.height < flat_height * extent.spacing &&
         std::ranges::all_of(plain.rim, [&](const RimEdge& edge) {
           const Vec3 N = double_area_vector(X, topology.F, edge.mesh_triangle);
           return angle_between(N, extent.normal) > angle;
         });
}

Index count_folds(const Patch& patch) {
  return audit_seam(patch, std::vector<Index>(static_cast<std::size_t>(patch.net.size()), 0), {1})
      .folds;
}

/// A sheet made by one method.
struct MadeSheet {
  Patch patch;
  FairingReport fairing = {};
  bool refined = true;
};

/// Nothing if the method fails or its result cannot be used.
std::optional<MadeSheet> make(const Patch& plain, const PatchMethod& method,
                              const PatchLimits& limits) {
  MadeSheet made{plain};
  try {
    if (method.kind == PatchKind::stationary) {
      made.fairing = refine_and_fair(made.patch, method.fairing, limits, made.refined);
    } else if (method.kind == PatchKind::plain) {
      split_taken_edges(made.patch);
    } else {
      made.refined = refine(made.patch, {1, false, limits.most_vertices});
    }
    if (method.kind == PatchKind::linear) {
      fair_linearly(made.patch);
    }
  } catch (const FactorizationFailed&) {
    return std::nullopt;
  }
  const bool has_failed =
      method.kind == PatchKind::stationary && (!made.fairing.converged || made.fairing.ran_away);
  if (has_failed || !made.patch.X.allFinite() ||
      limits.bound.is_exceeded(made.patch.X, made.patch.own_from) ||
      !(patch_area(made.patch) <= limits.bound.area) ||
      (count_folds(made.patch) > 0 && count_folds(plain) == 0)) {
    return std::nullopt;
  }
  return made;
}

void add(const FairingReport& part, FairingReport& all) {
  all.energy_before += part.energy_before;
  all.energy_after += part.energy_after;
  all.gradient_ratio = std::max(all.gradient_ratio, part.gradient_ratio);
  all.last_move = std::max(all.last_move, part.last_move);
  all.levels = std::max(all.levels, part.levels);
  all.steps += part.steps;
  all.flow.unknowns += part.flow.unknowns;
  all.flow.add_effort(part.flow);
}

}  // namespace

std::optional<ContinuedCreases> look_for_creases(const Points& X, const Topology& topology,
                                                 const Patch& plain, double angle) {
  ContinuedCreases creases;
  const auto loops = loops_of(plain.rim);
  for (const std::vector<RimEdge>& loop : loops) {
    creases.rim = find_rim_creases(X, topology, loop, plain.mesh_vertex, angle);
    creases.ends += std::ssize(creases.rim.ends);
    if (creases.rim.has_creases() && loops.size() > 1) {
      creases.network.flaw = "the patch has several loops";
      return creases;
    }
  }
  if (!creases.rim.has_creases()) {
    return std::nullopt;
  }
  const RimExtent extent(plain);
  creases.network =
      continue_creases(creases.rim, extent.middle, corner_reach * extent.radius, extent.spacing);
  if (creases.rim.ends.empty() && borders_flat_face(X, topology, plain, extent, angle)) {
    creases.rim.arcs = {{.normal = extent.normal}};
    creases.rim.on_crease.assign(plain.rim.size(), 1);
    creases.network = {.sheets = {{{SheetSide::Kind::arc, 0}}}};
  }
  return creases;
}

CreasedPatch fill_sheets(const Topology& topology, const Patch& plain,
                         const ContinuedCreases& creases, const FillOptions& options,
                         Index most_vertices) {
  std::vector<PatchMethod> methods = patch_methods(options);
  std::erase_if(methods, [](const PatchMethod& method) { return method.smooth_directions; });
  const SplitHole split(topology, plain, creases.rim, creases.network);
  if (split.crease_size() > most_vertices) {
    throw BadMesh("its creases alone exceed the limit of new vertices (--max-new-vertices)");
  }
  std::vector<Sheet> sheets;
  CreasedPatch result;
  result.fairing.converged = options.fair;
  result.fairing.gradient_ratio = 0;
  Index left = most_vertices - split.crease_size();
  for (std::size_t i = 0; i < split.size(); ++i) {
    sheets.push_back(split.cut(i));
    Patch& patch = sheets.back().patch;
    const PatchLimits limits{left, bound_of(patch)};
    const PatchMethod* used = &methods.front();
    std::optional<MadeSheet> made = make(patch, *used, limits);
    while (!made && used != &methods.back()) {
      made = make(patch, *++used, limits);
    }
    if (!made) {
      throw BadMesh("a sheet between its creases cannot be filled");
    }
    patch = std::move(made->patch);
    result.refined = result.refined && made->refined;
    left -= patch.own_size();
    add(made->fairing, result.fairing);
    if (options.fair && used->kind != PatchKind::stationary) {
      result.fairing.converged = false;
      ++result.other_sheets;
    }
  }
  result.patch = split.joined(sheets);
  return result;
}

}  // namespace ibmfair
