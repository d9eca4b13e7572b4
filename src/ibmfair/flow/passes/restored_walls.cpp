#include "ibmfair/flow/passes/restored_walls.h"

#include <cmath>

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/flow/steps/folds.h"
#include "ibmfair/flow/tuning.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

constexpr double rounding = 1e-9;  // relative to the thickness; such changes are left

class WallRestoration {
 public:
  WallRestoration(const Points& start, const Topology& topology,
                  const std::vector<std::uint8_t>& fixed, const ThinWalls& thin)
      : topology_(topology),
        fixed_(fixed),
        walls_(thin.walls),
        outward_(outward_signs(start, topology)),
        rings_(vertex_rings(topology)),
        folds_(start, topology) {}

  /// Whether a hinge has folded over at X.
  bool folds(const Points& X) const { return !folds_.new_folds(X).empty(); }

  /// One correction; false if it would fold the mesh however small it is made.
  bool correct(Points& X) const {
    const Points area_vectors = vertex_area_vectors(X, topology_);
    const PerVertex change = averaged(change_at_vertices(X, area_vectors));
    Points move = Points::Zero(X.rows(), 3);
    for (Index v = 0; v < topology_.vertex_count; ++v) {
      if (!fixed_[v] && change[v] != 0) {
        const Vec3 normal = Vec3(area_vectors.row(v)).stableNormalized();
        move.row(v) = -0.5 * outward_[topology_.component[v]] * change[v] * normal;
      }
    }
    for (int i = 0; i <= tuning.guard.most_halvings; ++i) {
      const Points Y = X + move;
      if (!folds(Y)) {
        X = Y;
        return true;
      }
      move /= 2;
    }
    return false;
  }

 private:
  /// The mean change in thickness of the walls at each vertex, weighted by area; 0 without walls.
  PerVertex change_at_vertices(const Points& X, const Points& area_vectors) const {
    PerVertex change = PerVertex::Zero(topology_.vertex_count),
              weight = PerVertex::Zero(topology_.vertex_count);
    for (Index t = 0; t < topology_.F.rows(); ++t) {
      if (!walls_[t].exists()) {
        continue;
      }
      const int outward = outward_[topology_.component[topology_.F(t, 0)]];
      const double area = double_area_vector(X, topology_.F, t).norm();
      const double more =
          thickness_at(X, area_vectors, topology_, t, walls_[t], outward) - walls_[t].thickness;
      if (std::abs(more) <= rounding * walls_[t].thickness) {
        continue;
      }
      for (const Index v : topology_.F.row(t)) {
        change[v] += area * more;
        weight[v] += area;
      }
    }
    return (weight.array() > 0).select(change.cwiseQuotient(weight), 0);
  }

  /// Each sweep replaces a value by the mean of the values of the vertex and its neighbours.
  PerVertex averaged(PerVertex values) const {
    for (int sweep = 0; sweep < tuning.thin_walls.sweeps; ++sweep) {
      const PerVertex before = values;
      for (Index v = 0; v < topology_.vertex_count; ++v) {
        double sum = before[v];
        for (const Index w : rings_[v]) {
          sum += before[w];
        }
        values[v] = sum / static_cast<double>(rings_[v].size() + 1);
      }
    }
    return values;
  }

  const Topology& topology_;
  const std::vector<std::uint8_t>& fixed_;
  const std::vector<Wall>& walls_;
  const std::vector<int> outward_;
  const CompressedRows rings_;
  const FoldWatch folds_;
};

}  // namespace

void restore_walls(const Points& start, const Topology& topology,
                   const std::vector<std::uint8_t>& fixed, const ThinWalls& thin,
                   std::string_view laplacian, Points& X) {
  const WallRestoration restoration(start, topology, fixed, thin);
  Points restored = X;
  for (int i = 0; i < tuning.thin_walls.corrections && restoration.correct(restored); ++i) {
  }
  const double most = bending_energy(start, topology, laplacian);
  for (const double share : {1.0, 0.95, 0.9, 0.8, 0.6, 0.3}) {
    const Points Y = X + share * (restored - X);
    if (bending_energy(Y, topology, laplacian) <= most && !restoration.folds(Y)) {
      X = Y;
      return;
    }
  }
}

}  // namespace ibmfair
