// What `smooth` reports of a mesh, for a mesh that is distributed over the ranks.
#pragma once

#include "commands/smooth_report.h"
#include "petsc_engine/petsc_parts.h"

namespace ibmfair::petsc {

/// Energy, area, volume and quality of the whole mesh with the piece's vertices at X (#V x 3). The
/// sign of the volume follows the orientation of the triangles in the file. Collective.
commands::MeshStatistics mesh_statistics(const MeshPiece& piece, const Points& X,
                                         const Topology& topology, const FlowOptions& options,
                                         const PetscParts& parts);

/// Gathers the defects of the whole mesh on the first rank, with the element numbers of the file.
/// Of the other members of the returned topology only E is set: to the non-manifold edges, as pairs
/// of the file's vertex numbers. Collective.
Topology gathered_defects(const Communicator& comm, const Topology& topology,
                          const MeshPiece& piece);

}  // namespace ibmfair::petsc
