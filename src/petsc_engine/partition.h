// Which rank a vertex belongs to.
#pragma once

#include <array>
#include <vector>

#include "ibmfair/base/types.h"
#include "petsc_engine/blocks.h"

namespace ibmfair::petsc {

/// For each vertex of this rank's block the rank that it shall belong to: parts of about the same
/// size between which few edges run, by PETSc's MatPartitioning (`-mat_partitioning_type`;
/// PT-Scotch by default). `triangles` are this rank's, with the vertices' numbers in the file.
/// Collective.
std::vector<int> partition_vertices(const Communicator& comm, const Blocks& vertices,
                                    const std::vector<std::array<Index, 3>>& triangles);

}  // namespace ibmfair::petsc
