#include "ibmfair/fill/rim_directions.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <unordered_map>
#include <vector>

#include <Eigen/QR>

#include "ibmfair/base/quantile.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

constexpr int fitted_rings = 5;    // around each vertex
constexpr int fitting_passes = 2;  // the first with equal weights

/// The part of the mesh around a rim that the fits need, as a graph with numbers of its own.
class Band {
 public:
  Band(const Topology& topology, const Patch& patch) {
    for (const RimEdge& edge : patch.rim) {
      add(patch.mesh_vertex[edge.a], 0);
    }
    for (std::size_t i = 0; i < vertex_.size(); ++i) {
      begin_.push_back(neighbor_.size());
      if (level_[i] > fitted_rings) {
        continue;
      }
      for (const Index t : topology.stars[vertex_[i]]) {
        for (const Index w : topology.F.row(t)) {
          const Index number = add(w, level_[i] + 1);
          const bool is_new = std::find(neighbor_.begin() + static_cast<std::ptrdiff_t>(begin_[i]),
                                        neighbor_.end(), number) == neighbor_.end();
          if (w != vertex_[i] && is_new) {
            neighbor_.push_back(number);
          }
        }
      }
    }
    begin_.push_back(neighbor_.size());
    seen_from_.assign(vertex_.size(), -1);
  }

  bool is_on_rim(Index number) const { return level_[number] == 0; }
  bool is_second(Index number) const { return level_[number] == 1; }
  Index number_of(Index mesh_vertex) const { return number_.at(mesh_vertex); }

  /// Numbers of the neighbours.
  std::span<const Index> neighbors(Index number) const {
    return std::span(neighbor_).subspan(begin_[number], begin_[number + 1] - begin_[number]);
  }

  /// Numbers of the vertices within `fitted_rings` rings of a vertex of the second ring: first the
  /// vertex itself, then its neighbours.
  std::vector<Index> around(Index number) {
    std::vector<Index> found{number};
    seen_from_[number] = number;
    std::size_t first = 0;
    for (int ring = 0; ring < fitted_rings; ++ring) {
      for (const std::size_t last = found.size(); first < last; ++first) {
        for (const Index w : neighbors(found[first])) {
          if (seen_from_[w] != number) {
            seen_from_[w] = number;
            found.push_back(w);
          }
        }
      }
    }
    return found;
  }

  /// Positions of these vertices relative to the first of them.
  Points relative_positions(const std::vector<Index>& numbers, const Points& X) const {
    Points result(static_cast<Eigen::Index>(numbers.size()), 3);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      result.row(static_cast<Eigen::Index>(i)) =
          X.row(vertex_[numbers[i]]) - X.row(vertex_[numbers[0]]);
    }
    return result;
  }

 private:
  Index add(Index mesh_vertex, int level) {
    const auto [place, is_new] =
        number_.try_emplace(mesh_vertex, static_cast<Index>(vertex_.size()));
    if (is_new) {
      vertex_.push_back(mesh_vertex);
      level_.push_back(level);
    }
    return place->second;
  }

  std::unordered_map<Index, Index> number_;  // of mesh vertices
  std::vector<Index> vertex_;                // the mesh vertex of each number
  std::vector<int> level_;                   // rings from the rim
  std::vector<std::size_t> begin_;           // of each vertex's neighbours in neighbor_
  std::vector<Index> neighbor_;
  std::vector<Index> seen_from_;  // the latest vertex whose surroundings contain this one
};

/// Heights of points above a plane through the origin, relative to a quadratic surface through
/// them: least squares with the weights of Cauchy's distribution.
Eigen::VectorXd offsets_from_quadric(const Points& X, const Vec3& normal) {
  using Terms = Eigen::Matrix<double, Eigen::Dynamic, 6>;
  using Square = Eigen::Matrix<double, 6, 6>;
  const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
  const double length = std::sqrt(X.rowwise().squaredNorm().mean());
  const Eigen::ArrayXd x = (X * u).array() / length, y = (X * v).array() / length;
  const Eigen::VectorXd height = X * normal;
  Terms terms(X.rows(), 6);
  terms << Eigen::ArrayXd::Ones(x.size()), x, y, x * x, x * y, y * y;
  if (terms.rows() < 2 * terms.cols()) {
    terms.rightCols<3>().setZero();  // a plane
  }
  Eigen::VectorXd weight = Eigen::VectorXd::Ones(terms.rows()), offset;
  for (int pass = 0; pass < fitting_passes; ++pass) {
    const Terms weighted = weight.asDiagonal() * terms;
    const Square normal_matrix = weighted.transpose().lazyProduct(terms);
    const Eigen::Matrix<double, 6, 1> right = weighted.transpose() * height;
    offset = height - terms * normal_matrix.colPivHouseholderQr().solve(right);
    std::vector<double> sorted(offset.size());
    std::ranges::transform(offset, sorted.begin(), [](double one) { return std::abs(one); });
    const double middle = median(sorted);
    if (!(middle > 0)) {
      break;
    }
    weight = (1 + (offset / (2 * middle)).array().square()).inverse();
  }
  return offset;
}

}  // namespace

std::vector<RingShift> direction_shifts(const Points& X, const Topology& topology,
                                        const Patch& patch) {
  Band band(topology, patch);
  std::vector<RingShift> shifts;
  for (Index i = 0; i < patch.own_from; ++i) {
    const Index vertex = patch.mesh_vertex[i], number = band.number_of(vertex);
    const Vec3 N = double_area_vector_at(vertex, X, topology);
    if (!band.is_second(number) || !(N.norm() > 0)) {
      continue;
    }
    const Vec3 normal = N.normalized();
    const Eigen::VectorXd offset =
        offsets_from_quadric(band.relative_positions(band.around(number), X), normal);
    double sum = 0;
    int count = 0, place = 1;
    for (const Index neighbor : band.neighbors(number)) {
      if (band.is_on_rim(neighbor)) {
        sum += offset[place];
        ++count;
      }
      ++place;
    }
    shifts.push_back({i, normal, sum / count - offset[0]});
  }
  return shifts;
}

double likeness_of_neighbors(const std::vector<RingShift>& shifts, const Topology& topology,
                             const Patch& patch) {
  std::unordered_map<Index, double> distance;  // of mesh vertices
  double squares = 0;
  for (const RingShift& shift : shifts) {
    distance[patch.mesh_vertex[shift.vertex]] = shift.distance;
    squares += shift.distance * shift.distance;
  }
  double products = 0;
  std::int64_t pairs = 0;
  for (const auto& [v, at_v] : distance) {
    for (const Index w : grown_by_ring(topology, {v})) {
      const auto other = distance.find(w);
      if (w != v && other != distance.end()) {
        products += at_v * other->second;
        ++pairs;
      }
    }
  }
  const double variance = squares / static_cast<double>(shifts.size());
  return pairs > 0 && variance > 0 ? products / static_cast<double>(pairs) / variance : 1;
}

void smooth_directions(const std::vector<RingShift>& shifts, Patch& patch) {
  for (const RingShift& shift : shifts) {
    patch.X.row(shift.vertex) += (shift.distance * shift.normal).transpose();
  }
}

}  // namespace ibmfair
