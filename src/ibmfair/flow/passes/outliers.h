// Outliers: vertices, alone or a few side by side, far off the surface that the others form, as
// failed measurements and damaged files leave them. A flow of the whole mesh that removes them,
// each as high as several edges are long, also removes details that are much lower.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Vertices that are outliers, and where they belong.
struct Outliers {
  std::vector<Index> vertices;  ///< in increasing order
  Points positions;             ///< #vertices x 3, on the surface that their neighbours form

  bool empty() const { return vertices.empty(); }
  /// Moves these vertices of X (#V x 3) to their positions.
  void move_in(Points& X) const;
};

/// The outliers of a mesh at X (#V x 3) among the vertices that are not `fixed` (#V flags). A
/// vertex is predicted by those around it: an interior one by the mean of its neighbours, one of an
/// open boundary by rim_extrapolation() (flow/passes/rim_extrapolation.h), of whose error only the
/// part along the surface's normal counts: outlines of any form are allowed. The distance of an
/// outlier from its prediction is large in three respects, whose limits are in OutlierTuning:
/// beside the mean distance of its neighbours from there; by this ratio beside the median of all
/// vertices; and beside what is uneven around the vertex, the median distance of its neighbours
/// from their predictions. Noise of one strength is as uneven around a vertex as at it, and so are
/// the tips of thorns. Of outliers side by side each makes the surface uneven around the others, so
/// that for the third respect all vertices that are far off in the first two are moved at once to
/// their predictions. Of outliers that are connected by edges there are fewer than of vertices
/// around them.
///
/// The positions minimise the energy sum |prediction - x|^2 over all predicted vertices (inside,
/// the energy of the umbrella Laplacian), with all vertices but the outliers fixed. The result
/// moves, turns and grows with the mesh. Takes time linear in the size of the mesh.
Outliers find_outliers(const Points& X, const Topology& topology,
                       const std::vector<std::uint8_t>& fixed);

}  // namespace ibmfair
