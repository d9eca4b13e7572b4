// Closes holes by patches of new vertices and triangles, which are numbered after those of the
// mesh, and reports the quality of each patch.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/fill/holes.h"
#include "ibmfair/fill/patch.h"
#include "ibmfair/fill/patch_audit.h"
#include "ibmfair/fill/patch_fairing.h"
#include "ibmfair/fill/surroundings.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Called with the number of finished holes and the number of all holes to fill, one call at a
/// time, from any thread.
using HoleObserver = std::function<void(std::int64_t finished, std::int64_t all)>;

/// What a patch continues at the rim of its hole.
enum class Continuity : std::uint8_t {
  positions,  ///< the rim alone: the patch of least area, a flat lid on a planar rim
  tangents,   ///< also the directions of the mesh: linear fairing
  curvature,  ///< also the curvature of the mesh, as far as the energy knows it: the Willmore flow
};

struct FillOptions {
  Continuity continuity = Continuity::curvature;
  FairingOptions fairing;  ///< for Continuity::curvature
  /// The patch takes its directions at the rim from a wider band (fill/rim_directions.h).
  bool smooth_directions = false;
  /// After the fairing, the patch continues the curvature of the mesh around its hole
  /// (fill/curvature_continuation.h). Its energy is then not stationary.
  bool continue_curvature = false;
  /// The mesh around each hole decides on its patch's Laplacian, with the mass matrix that belongs
  /// to it, on `smooth_directions` and on `continue_curvature`, instead of these options
  /// (fill/patch_methods.h).
  bool choose_by_surroundings = false;
  /// Sharp edges that end at the rim go on through the patch (fill/continued_creases.h): edges at
  /// which the surface turns by more than this angle, radians. 0: no edge counts as sharp. Needs
  /// `refine` and no `rim_smooth`. A hole whose creases do not fit together is filled without them.
  double sharp_angle = 0;
  bool choose_sharp_angle = false;  ///< the mesh decides on `sharp_angle` (fill/sharp_lines.h)
  bool refine = true;  ///< false: new vertices only to avoid edges that the mesh has already
  /// Edge length of the triangles inside of the patches, length. From the rim on, the edge length
  /// changes gradually to this one. 0: the edge length along the rim.
  double edge_length = 0;
  bool fair = true;
  int rim_smooth = 0;  ///< rings of mesh vertices that may move; the loop is the first ring
  /// The most new vertices in all holes together. 0: the number of vertices of the mesh, but at
  /// least 100,000; and about n^2 / 2 in a hole of n edges, several times the number that a patch
  /// like a half sphere needs, but less than a balloon would need. A hole in which more than a half
  /// sphere is missing may get twice as many as its sphere needs. No patch gets many more than the
  /// largest patch within its bound needs, even if this number is larger.
  Index most_new_vertices = 0;
  HoleObserver on_hole = {};
};

enum class HoleStatus : std::uint8_t {
  filled,
  not_converged,  ///< filled, but the fairing did not reach its tolerance
  coarse,         ///< filled, but `most_new_vertices` ended the refinement
  failed,         ///< left open although it was to be filled
  skipped,        ///< left open by choice
};

/// "filled", "not converged", ...
std::string_view name_of(HoleStatus status);

/// A patch that was made for a hole, but not used.
struct RejectedPatch {
  std::string method;  ///< how it was made
  std::string reason;  ///< without a full stop
};

/// What became of the creases that reach the rim of a hole.
struct CreaseReport {
  std::int64_t ends = 0;       ///< the number of creases that end at the rim
  std::int64_t left_out = 0;   ///< the number of these that are not continued
  std::int64_t rim_edges = 0;  ///< the number of edges of the rim that lie on a crease
  std::int64_t curves = 0;     ///< the number of curves in the patch that continue them
  std::int64_t corners = 0;    ///< the number of places in the patch at which these curves meet
  std::string reason;          ///< why the creases are not continued; empty if they are
};

struct HoleReport {
  Index hole = 0;  ///< Hole::id
  HoleStatus status = HoleStatus::skipped;
  std::string reason;     ///< for every status except `filled`; without a full stop
  Index bridged_to = -1;  ///< the hole at the other end of a bridge, or -1
  std::string method;     ///< how the patch was made; empty for a hole that stays open
  std::optional<RimSurroundings> surroundings;  ///< if they decided on the method
  std::vector<RejectedPatch> rejected;          ///< the methods that were tried before
  std::vector<Index> protruding;                ///< Patch::protruding
  std::optional<CreaseReport> creases;          ///< if creases reach the rim
  std::int64_t new_vertices = 0, new_triangles = 0;
  double diameter_ratio = 0;  ///< diagonal of the patch's bounding box / that of the hole's
  double area_ratio = 0;      ///< area of the patch / that of the triangulated polygon
  SeamAudit seam;
  std::int64_t intersections = 0;  ///< pairs of triangles: patch with patch, or patch with mesh
  FairingReport fairing;           ///< shared by holes that touch and were faired together
};

/// The patches that fill the holes.
struct Filling {
  Points X;                             ///< #V x 3: the mesh; only `rim_smooth` moves vertices
  Points new_X;                         ///< #new vertices x 3, numbered from #V on
  Triangles new_F;                      ///< #new triangles x 3
  std::vector<Index> model_triangle;    ///< #new triangles: the nearest triangle of the mesh
  std::vector<Index> hole_of_triangle;  ///< #new triangles: Hole::id
  std::vector<HoleReport> holes;        ///< one for every hole of the mesh, by id
  std::vector<Patch> patches;           ///< in the order of their vertices in `new_X`
  std::vector<Index> fins;              ///< triangles of fins (fill/fins.h), which were left aside
  double audit_seconds = 0;             ///< spent on the search for intersections

  /// Extends values at the vertices `rim()` (one row each) harmonically to the new vertices, patch
  /// by patch. Returns one row per new vertex.
  Eigen::MatrixXd extend(const Eigen::MatrixXd& at_rim) const;

  /// The mesh's vertices at the rims of the filled holes, sorted.
  std::vector<Index> rim() const;
};

/// The mesh with its patches: `filling.X` and the triangles of `topology` first.
struct FilledMesh {
  Points X;
  Triangles F;
};
FilledMesh filled_mesh(const Topology& topology, const Filling& filling);

/// Fills the holes that `choice` selects, and joins its pairs of holes by tubes. Each hole is
/// triangulated, refined and faired separately (holes that touch, and both ends of a tube:
/// together). Holes are filled in parallel; the result does not depend on the number of threads.
///
/// A patch is used only if it stays within the bound that the surroundings of its hole suggest
/// (fill/patch_bound.h), if its fairing converged, and if it has no intersections and foldovers
/// that the triangulated polygon does not have. Otherwise other methods are tried in a fixed order
/// (fill/patch_methods.h). A hole that cannot be filled is left open, and its report gives the
/// reason. Throws BadOption for options that cannot be used.
Filling fill_holes(const Points& X, const Topology& topology, const HoleChoice& choice,
                   const FillOptions& options);

}  // namespace ibmfair
