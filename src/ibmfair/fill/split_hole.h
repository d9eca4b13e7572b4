// A hole that continued creases divide into sheets. Each sheet is a hole of its own: its border
// consists of parts of the rim and of creases.
#pragma once

#include <vector>

#include "ibmfair/fill/crease_network.h"
#include "ibmfair/fill/patch.h"
#include "ibmfair/fill/rim_creases.h"

namespace ibmfair {

/// The patch of one sheet, which can be refined and faired like any other. Its rim contains the
/// creases, whose vertices do not move. The surroundings are the triangles of the sheet along its
/// part of the rim, and beyond each crease a strip of made-up triangles, which continue the sheet
/// so that the patch has a direction there. Nothing depends on the sheet on the other side.
struct Sheet {
  Patch patch;
  /// For each vertex before the patch's own: its number in the whole patch; -1 for vertices of
  /// made-up triangles.
  std::vector<Index> number;
};

class SplitHole {
 public:
  /// `plain`: the triangulated hole, of one loop and without vertices of its own. All arguments
  /// must outlive this object.
  SplitHole(const Topology& topology, const Patch& plain, const CreasedRim& rim,
            const CreaseNetwork& network);

  std::size_t size() const { return network_.sheets.size(); }

  /// The number of vertices on the creases, without the rim.
  Index crease_size() const { return crease_size_; }

  /// The triangulated sheet. Throws BadMesh if it cannot be triangulated.
  Sheet cut(std::size_t i) const;

  /// The patch of the hole that consists of these sheets.
  Patch joined(const std::vector<Sheet>& sheets) const;

 private:
  const Topology& topology_;
  const Patch& plain_;
  const CreasedRim& rim_;
  const CreaseNetwork& network_;
  std::vector<std::vector<Index>> on_curve_;  // per curve: the numbers of its vertices
  Points all_X_;                              // of the mesh's vertices and of those on creases
  Index crease_size_ = 0;
};

}  // namespace ibmfair
