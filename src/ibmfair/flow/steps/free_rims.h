// Free rims: open boundaries whose vertices the flow may move.
//
// The bending energy of a hinge is 3 |e|^2 / A (1 + cos theta), and its force has a bending part
// f^B, which turns the triangles, and a part f^P within the surface, which changes |e|^2 / A: [W07]
// (15). Inside the surface, the forces f^P of the hinges around a vertex nearly cancel. At a rim
// nothing balances them: while a hinge is bent, as noise bends all of them, its energy falls as the
// triangles at the rim grow, and rim vertices would be pulled out without end. The same holds for
// every Laplacian of the family, as all energies fall if the surface at the rim is stretched. So
// the vertices of a free rim move along the normal of the surface only, as f^B alone would move
// them.
#pragma once

#include <vector>

#include "ibmfair/base/compressed_rows.h"
#include "ibmfair/energy/unknowns.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// The unknowns on open boundaries, with their normals.
class FreeRims {
 public:
  /// The topology must outlive this object. `start` (#V x 3): the positions at the start.
  FreeRims(const Points& start, const Topology& topology, const Unknowns& unknowns);

  bool empty() const { return vertices_.empty(); }

  /// Finds the normals of the surface at these vertices at `X` (#V x 3). They have no sign, so that
  /// surfaces that are not orientable have them as well.
  void find_normals(const Points& X);

  /// Replaces the rows of these unknowns (one row per unknown) by their parts along the normals.
  void project(Points& rows) const;

  /// Writes the moves (one row per unknown, length) of these vertices at `X` (#V x 3) toward the
  /// mean of their neighbours, until they are not farther from it than at the start
  /// (RimTuning). Straight moves along the normal lengthen the edges of a triangle that turns
  /// about its inner edge, and needles at a rim turn in every step. Returns false, with `move`
  /// unchanged, if all vertices are near enough.
  bool pull_in(const Points& X, Points& move) const;

 private:
  const Topology& topology_;
  Index unknown_count_;
  std::vector<Index> vertices_, unknowns_;
  CompressedRows neighbours_;  // one row per free vertex
  Eigen::VectorXd reach_;      // length; the largest distance from the mean of the neighbours
  Points normals_;             // one row per free vertex, unit length
};

}  // namespace ibmfair
