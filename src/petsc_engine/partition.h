// Partitioning of the vertices among the ranks.
#pragma once

#include <array>
#include <vector>

#include "ibmfair/base/types.h"
#include "petsc_engine/blocks.h"

namespace ibmfair::petsc {

/// Returns, for each vertex of this rank's block, the rank that the vertex shall belong to. The
/// parts have about the same size and few edges between them; they are computed by PETSc's
/// MatPartitioning (`-mat_partitioning_type`; PT-Scotch by default). `triangles` are the triangles
/// of this rank's block, with the file's vertex numbers. Collective.
std::vector<int> partition_vertices(const Communicator& comm, const Blocks& vertices,
                                    const std::vector<std::array<Index, 3>>& triangles);

}  // namespace ibmfair::petsc
