// What `smooth` tells of a mesh, of one in several parts.
#pragma once

#include "commands/smooth_report.h"
#include "petsc_engine/petsc_parts.h"

namespace ibmfair::petsc {

/// Energy, area, volume and quality of the whole mesh with the piece's vertices at X (#V x 3). The
/// volume takes the orientation that the triangles have in the file. Collective.
commands::MeshFigures mesh_figures(const MeshPiece& piece, const Points& X,
                                   const Topology& topology, const FlowOptions& options,
                                   const PetscParts& parts);

/// The defects of the whole mesh, by their numbers in the file, on the first rank; nothing else of
/// the topology is there. Collective.
Topology gathered_defects(const Communicator& comm, const Topology& topology,
                          const MeshPiece& piece);

}  // namespace ibmfair::petsc
