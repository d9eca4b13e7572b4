// Differences between two meshes with the same connectivity.
#pragma once

#include "ibmfair/measure/normal_angles.h"
#include "ibmfair/measure/statistics.h"
#include "ibmfair/mesh/mesh.h"

namespace ibmfair {

/// Whether two meshes have as many vertices and the same faces, corner by corner.
bool same_connectivity(const Mesh& a, const Mesh& b);

/// Distances between vertices of the same number, length. Precondition: as many in both.
Statistics vertex_differences(const Points& A, const Points& B);

/// Between the normals of polygons of the same number. Every one counts the same, so that the mean
/// is the "normal error" of the literature on mesh denoising. Precondition: same_connectivity.
NormalAngles face_normal_angles(const Mesh& a, const Mesh& b);

}  // namespace ibmfair
