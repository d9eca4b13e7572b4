// Closes holes: new vertices and triangles behind those of the mesh, and an audit of each hole.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/fill/holes.h"
#include "ibmfair/fill/patch.h"
#include "ibmfair/fill/patch_audit.h"
#include "ibmfair/fill/patch_fairing.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Told of the holes that are finished and of all that are to be filled, one call at a time, from
/// any thread.
using HoleObserver = std::function<void(std::int64_t finished, std::int64_t all)>;

struct FillOptions {
  FairingOptions fairing;
  bool refine = true;  ///< false: no new vertices, but where an edge of the mesh is in the way
  bool fair = true;
  int rim_smooth = 0;  ///< rings of vertices outside that may move, the loop being the first
  /// In all holes together; 0: as many as the mesh has, or 100,000, and in a hole of n edges half
  /// the square of n: several times what a patch like a half sphere needs, not what a balloon does.
  Index most_new_vertices = 0;
  HoleObserver on_hole = {};
};

enum class HoleStatus : std::uint8_t {
  filled,
  not_converged,  ///< filled, but the fairing did not reach its tolerance
  coarse,         ///< filled, but the limit of new vertices ended the refinement
  failed,         ///< left open although it was to be filled
  skipped,        ///< left open by choice
};

/// "filled", "not converged", ...
std::string_view name_of(HoleStatus status);

struct HoleReport {
  Index hole = 0;  ///< Hole::id
  HoleStatus status = HoleStatus::skipped;
  std::string reason;  ///< for all but `filled`, without a full stop
  std::int64_t new_vertices = 0, new_triangles = 0;
  SeamAudit seam;
  std::int64_t intersections = 0;  ///< pairs of triangles, the patch's with its own or the mesh's
  FairingReport fairing;           ///< of the holes that were faired together, as they touch
};

/// What fills the holes.
struct Filling {
  Points X;                             ///< #V x 3: the mesh's vertices, moved only by `rim_smooth`
  Points new_X;                         ///< #new vertices x 3, numbered from #V on
  Triangles new_F;                      ///< #new triangles x 3
  std::vector<Index> model_triangle;    ///< #new triangles: the triangle of the mesh nearest to it
  std::vector<Index> hole_of_triangle;  ///< #new triangles: Hole::id
  std::vector<HoleReport> holes;        ///< one for every hole of the mesh, by id
  std::vector<Patch> patches;           ///< in the order of their vertices in `new_X`
  double audit_seconds = 0;             ///< spent on the search for intersections

  /// Extends values at `rim()` (a row each) to the new vertices: harmonically, patch by patch.
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

/// Fills the holes that `choice` lets pass. Each is triangulated, refined and faired on its own,
/// those that touch together, in parallel; the result does not depend on the number of threads. A
/// hole that cannot be filled is left as it is, with the reason. Throws BadOption for options that
/// cannot be used.
Filling fill_holes(const Points& X, const Topology& topology, const HoleChoice& choice,
                   const FillOptions& options);

}  // namespace ibmfair
