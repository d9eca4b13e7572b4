// The vertices that are the unknowns of a linear system.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// Numbers the vertices that are solved for.
struct Unknowns {
  std::vector<Index> vertex;  ///< the vertex of each unknown, in increasing order
  /// #V, the unknown of each vertex, or -1 if the vertex is fixed. Numbers >= size() belong to
  /// vertices of other parts of the mesh.
  std::vector<Index> unknown;

  Unknowns() = default;
  /// `own`: #V, or empty for all: the vertices that belong to this part of the mesh. Precondition:
  /// in the order of the vertices, this part's free vertices come before those of other parts.
  explicit Unknowns(const std::vector<std::uint8_t>& fixed,
                    const std::vector<std::uint8_t>& own = {});
  Index size() const { return static_cast<Index>(vertex.size()); }
};

}  // namespace ibmfair
