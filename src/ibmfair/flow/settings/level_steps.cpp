#include "ibmfair/flow/settings/level_steps.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "ibmfair/flow/settings/choice_tuning.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

/// Levels at multiples of one distance.
struct Levels {
  double distance = 0;  ///< length; 0 if the coordinates are not on levels
  double used = 0;      ///< ratio of the levels between the first and the last with a coordinate
};

/// `least_step`: the least distance of levels, mean edge lengths.
Levels levels_of(const Eigen::VectorXd& coordinates, double mean_edge, double least_step) {
  std::vector<double> sorted(coordinates.begin(), coordinates.end());
  std::sort(sorted.begin(), sorted.end());
  const double rounding = choice_tuning.noise.off_level * mean_edge;
  double distance = 0, used = 1;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const double gap = sorted[i] - sorted[i - 1];
    if (!(gap > rounding)) {
      continue;
    }
    if (gap < least_step * mean_edge) {
      return {};
    }
    distance = distance == 0 ? gap : std::min(distance, gap);
    ++used;
  }
  const double range = sorted.back() - sorted.front();
  if (!(range > (choice_tuning.noise.least_levels - 1.5) * distance)) {
    return {};
  }
  const bool on_levels = std::all_of(sorted.begin(), sorted.end(), [&](double x) {
    const double level = (x - sorted.front()) / distance;
    return std::abs(level - std::round(level)) * distance <= rounding;
  });
  return on_levels ? Levels{distance, used / (range / distance + 1)} : Levels();
}

/// The squared components of the normals, weighted by the areas; their sum is 1.
Vec3 squared_normal(const Points& X, const Topology& topology) {
  Vec3 sum = Vec3::Zero();
  double area = 0;
  for (Eigen::Index t = 0; t < topology.F.rows(); ++t) {
    const Vec3 normal = double_area_vector(X, topology.F, t);
    if (const double length = normal.norm(); length > 0) {
      sum += normal.cwiseAbs2() / length;
      area += length;
    }
  }
  return area > 0 ? Vec3(sum / area) : sum;
}

double share_of_bent_hinges(const Points& X, const Topology& topology) {
  const Eigen::VectorXd angles = dihedral_angles(X, topology.H);
  const double flat = std::numbers::pi - choice_tuning.noise.bent;
  return static_cast<double>((angles.array() < flat).count()) /
         static_cast<double>(std::max<Eigen::Index>(angles.size(), 1));
}

}  // namespace

double level_step(const Points& X, const Topology& topology) {
  if (X.rows() == 0 || topology.E.rows() == 0) {
    return 0;
  }
  const double mean_edge = mean_edge_length(X, topology.E);
  Vec3 distance;
  for (int axis = 0; axis < 3; ++axis) {
    distance[axis] = levels_of(X.col(axis), mean_edge, choice_tuning.noise.least_step).distance;
  }
  const Vec3 normal = squared_normal(X, topology);
  const double along = (distance.array() > 0).select(normal.array(), 0.0).sum();
  if (!(along > choice_tuning.noise.along_axes &&
        share_of_bent_hinges(X, topology) > choice_tuning.noise.bent_hinges)) {
    return 0;
  }
  return std::sqrt(distance.cwiseAbs2().dot(normal) / along);
}

bool is_rounded(const Points& X, const Topology& topology) {
  const double mean_edge = mean_edge_length(X, topology.E);
  const Vec3 normal = squared_normal(X, topology);
  for (int axis = 0; axis < 3; ++axis) {
    if (normal[axis] > choice_tuning.noise.along_rounded) {
      const auto [step, used] = levels_of(X.col(axis), mean_edge, choice_tuning.noise.negligible);
      return step > 0 && step < choice_tuning.noise.largest_step * mean_edge &&
             used > choice_tuning.noise.levels_used &&
             share_of_bent_hinges(X, topology) > choice_tuning.noise.bent_hinges;
    }
  }
  return false;
}

}  // namespace ibmfair
