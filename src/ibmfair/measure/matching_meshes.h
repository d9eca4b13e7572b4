// Differences between two meshes with the same connectivity.
#pragma once

#include "ibmfair/measure/normal_angles.h"
#include "ibmfair/measure/statistics.h"
#include "ibmfair/mesh/mesh.h"

namespace ibmfair {

/// Whether two meshes have the same number of vertices and the same faces, corner by corner.
bool same_connectivity(const Mesh& a, const Mesh& b);

/// Distances between vertices with the same number, length. Precondition: equal numbers of
/// vertices.
Statistics vertex_differences(const Points& A, const Points& B);

/// Angles between the normals of polygons with the same number. Every polygon has equal weight, so
/// that the mean is the "normal error" of the literature on mesh denoising. Precondition:
/// same_connectivity.
NormalAngles face_normal_angles(const Mesh& a, const Mesh& b);

}  // namespace ibmfair
