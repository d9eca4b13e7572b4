// The counts, topology and sizes of a mesh.
#pragma once

#include <cstdint>
#include <optional>

#include "ibmfair/base/types.h"
#include "ibmfair/mesh/mesh.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

struct MeshSummary {
  Index vertices = 0;
  Index isolated_vertices = 0;  ///< vertices that belong to no triangle
  Index faces = 0;              ///< polygons
  Index triangles = 0;          ///< after triangulation of the polygons
  Index edges = 0;              ///< edges of the triangles
  Index hinges = 0;             ///< interior edges between two usable triangles

  Index components = 0;
  bool orientable = true;
  Index turned_triangles = 0;  ///< triangles oriented against the majority of their component
  bool closed = false;         ///< whether every edge lies between exactly two triangles
  std::int64_t euler_characteristic = 0;
  /// Summed over the components; none unless the mesh is an orientable surface.
  std::optional<std::int64_t> genus;
  Index boundary_loops = 0;
  Index longest_loop = 0;  ///< edges

  double shortest_edge = 0.0;    ///< length
  double mean_edge = 0.0;        ///< length
  double longest_edge = 0.0;     ///< length
  double smallest_angle = 0.0;   ///< degrees
  double area = 0.0;             ///< length^2
  std::optional<double> volume;  ///< length^3, positive where oriented outward; none unless the
                                 ///< mesh is closed and orientable
  Vec3 smallest_corner = Vec3::Zero();  ///< corner of the bounding box of all vertices
  Vec3 largest_corner = Vec3::Zero();
};

/// `topology` must be the topology of the triangulation F of `mesh`.
MeshSummary summarise(const Mesh& mesh, const Topology& topology);

}  // namespace ibmfair
