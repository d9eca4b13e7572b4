// Closes cracks (fill/cracks.h) without new vertices: splits edges at T-junctions, and merges
// vertices of edges that lie on each other. No vertex moves.
#pragma once

#include <vector>

#include "ibmfair/fill/cracks.h"
#include "ibmfair/io/face_edits.h"
#include "ibmfair/io/weld.h"
#include "ibmfair/mesh/mesh.h"

namespace ibmfair {

/// The faces that take the place of those at split edges. A triangle becomes as many triangles as
/// are needed. A larger polygon gets the vertices as further corners, or becomes triangles if it
/// cannot be cut into triangles with area otherwise. Every triangle has area if the old face has,
/// and if the vertices lie near the edge.
std::vector<FaceEdit> split_faces(const Mesh& mesh, const std::vector<EdgeSplit>& splits);

/// The mesh with its cracks closed. Its vertices are numbered as those of `mesh`; vertices that
/// stand for another one no longer belong to a face.
Mesh stitched(const Mesh& mesh, const Cracks& cracks);

/// The file of a mesh with its cracks closed. Its bytes stay as they are except for the faces at
/// T-junctions (io/face_edits.h). If vertices are merged, the file is generated when it is written.
EditedFile stitched(const MeshFile& file, const Cracks& cracks);

/// What is open in a mesh.
struct OpenParts {
  Index components = 0;
  Index boundary_loops = 0;
  Index holes = 0;               ///< boundary loops that are no outer borders (fill/holes.h)
  Index non_manifold_edges = 0;  ///< edges of three or more triangles
  bool closed = false;           ///< no boundary loops, and no edges of three or more triangles
};

OpenParts open_parts(const Mesh& mesh);

/// What would be open after welding.
OpenParts open_parts_after(const Weld& weld, const Mesh& mesh);

}  // namespace ibmfair
