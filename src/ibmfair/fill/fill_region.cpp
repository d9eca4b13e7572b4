#include "ibmfair/fill/fill_region.h"

#include "ibmfair/base/errors.h"
#include "ibmfair/flow/steps/folds.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

std::int64_t count_folds(const Points& X, const Topology& topology,
                         const std::vector<std::uint8_t>& region) {
  const Eigen::VectorXd angles = dihedral_angles(X, topology.H);
  std::int64_t folds = 0;
  for (Eigen::Index h = 0; h < topology.H.rows(); ++h) {
    const auto x = topology.H.row(h);
    const bool touched = region[x[0]] || region[x[1]] || region[x[2]] || region[x[3]];
    folds += touched && angles[h] < fold_angle ? 1 : 0;
  }
  return folds;
}

}  // namespace

RegionReport fair_region(Points& X, const Topology& topology,
                         const std::vector<std::uint8_t>& region, const FairingOptions& options) {
  options.validate();
  std::vector<Index> vertices;
  for (Index v = 0; v < topology.vertex_count; ++v) {
    if (region[v] && topology.kind[v] == VertexKind::interior && !topology.defective[v]) {
      vertices.push_back(v);
    }
  }
  if (vertices.empty()) {
    throw BadOption(
        "--region: no vertex of the region may move, because all of them lie on its border, at an "
        "open boundary of the mesh or at a defect");
  }
  Patch patch = cut_region(X, topology, vertices);
  RegionReport report;
  report.fairing = fair(patch, options);
  for (Index v = 0; v < patch.own_from; ++v) {
    if (patch.free[v]) {
      X.row(patch.mesh_vertex[v]) = patch.X.row(v);
    }
  }
  report.folds = count_folds(X, topology, region);
  return report;
}

std::vector<std::uint8_t> inner_vertices(const Topology& topology,
                                         const std::vector<std::uint8_t>& region) {
  std::vector<std::uint8_t> outside(region.size());
  for (std::size_t v = 0; v < region.size(); ++v) {
    outside[v] = region[v] ? 0 : 1;
  }
  outside = grow_one_ring(topology, outside);
  for (std::uint8_t& flag : outside) {
    flag = flag ? 0 : 1;
  }
  return outside;
}

}  // namespace ibmfair
