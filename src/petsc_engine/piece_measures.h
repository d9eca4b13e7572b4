// What `smooth` tells of a mesh, of one in several parts.
#pragma once

#include <array>
#include <cstdint>

#include "commands/smooth_report.h"
#include "petsc_engine/petsc_parts.h"

namespace ibmfair::petsc {

/// Energy, area, volume and quality of the whole mesh with the piece's vertices at X (#V x 3). The
/// volume takes the orientation that the triangles have in the file. Collective.
commands::MeshFigures mesh_figures(const MeshPiece& piece, const Points& X,
                                   const Topology& topology, const FlowOptions& options,
                                   const PetscParts& parts);

/// Throws BadMesh with `strict`, or returns a warning for each kind of defect with their number;
/// the same on all ranks. Collective.
std::vector<commands::Warning> defect_warnings(const Topology& topology, const MeshPiece& piece,
                                               const PetscParts& parts, bool strict);

}  // namespace ibmfair::petsc
