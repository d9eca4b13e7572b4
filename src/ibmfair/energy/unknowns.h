// Which vertices a linear system is about.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// Numbers the vertices that are solved for.
struct Unknowns {
  std::vector<Index> vertex;  ///< the vertex of each unknown, in increasing order
  /// #V, the unknown of each vertex, or -1 where it is held fixed. Numbers from size() on are those
  /// of vertices that belong to other parts of the mesh (flow/mesh_parts.h).
  std::vector<Index> unknown;

  Unknowns() = default;
  /// `own`: #V, or empty for all, which vertices belong to this part; these come first.
  explicit Unknowns(const std::vector<std::uint8_t>& fixed,
                    const std::vector<std::uint8_t>& own = {});
  Index size() const { return static_cast<Index>(vertex.size()); }
};

}  // namespace ibmfair
