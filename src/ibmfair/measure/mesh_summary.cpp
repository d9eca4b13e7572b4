#include "ibmfair/measure/mesh_summary.h"

#include <algorithm>

#include "ibmfair/base/angle.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {

namespace {

void count_elements(const Mesh& mesh, const Topology& topology, MeshSummary& summary) {
  summary.vertices = static_cast<Index>(mesh.X.rows());
  summary.isolated_vertices = static_cast<Index>(
      std::count(topology.kind.begin(), topology.kind.end(), VertexKind::isolated));
  summary.faces = mesh.faces.size();
  summary.triangles = static_cast<Index>(topology.F.rows());
  summary.edges = static_cast<Index>(topology.E.rows());
  summary.hinges = static_cast<Index>(topology.H.rows());
}

void describe_topology(const Topology& topology, MeshSummary& summary) {
  const Defects& defects = topology.defects;
  summary.components = topology.component_count;
  summary.orientable = topology.orientable;
  summary.turned_triangles = topology.turned_triangles;
  summary.euler_characteristic = topology.euler_characteristic();
  summary.boundary_loops = static_cast<Index>(topology.boundary_loops.size());
  for (const BoundaryLoop& loop : topology.boundary_loops) {
    summary.longest_loop = std::max(summary.longest_loop, static_cast<Index>(loop.vertices.size()));
  }
  summary.closed =
      summary.components > 0 && summary.boundary_loops == 0 && defects.non_manifold_edges.empty();
  const bool surface = defects.non_manifold_edges.empty() && defects.bow_tie_vertices.empty() &&
                       defects.repeated_corner.empty();
  if (surface && summary.orientable && summary.components > 0) {
    summary.genus = (2 * std::int64_t{summary.components} - summary.boundary_loops -
                     summary.euler_characteristic) /
                    2;
  }
}

void measure(const Points& X, const Topology& topology, MeshSummary& summary) {
  if (topology.E.rows() > 0) {
    Eigen::VectorXd lengths(topology.E.rows());
    for (Eigen::Index e = 0; e < lengths.size(); ++e) {
      lengths[e] = (X.row(topology.E(e, 1)) - X.row(topology.E(e, 0))).stableNorm();
    }
    summary.shortest_edge = lengths.minCoeff();
    summary.mean_edge = lengths.mean();
    summary.longest_edge = lengths.maxCoeff();
  }
  summary.smallest_angle = degrees(smallest_angle(X, topology.F));
  summary.area = surface_area(X, topology.F);
  if (summary.closed && summary.orientable) {
    summary.volume = enclosed_volume(X, topology.F);
  }
  if (X.rows() > 0) {
    summary.smallest_corner = X.colwise().minCoeff();
    summary.largest_corner = X.colwise().maxCoeff();
  }
}

}  // namespace

MeshSummary summarise(const Mesh& mesh, const Topology& topology) {
  MeshSummary summary;
  count_elements(mesh, topology, summary);
  describe_topology(topology, summary);
  measure(mesh.X, topology, summary);
  return summary;
}

}  // namespace ibmfair
