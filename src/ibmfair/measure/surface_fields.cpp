#include "ibmfair/measure/surface_fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "ibmfair/base/named_row.h"
#include "ibmfair/base/parallel.h"
#include "ibmfair/measure/displacement.h"
#include "ibmfair/measure/energy_density.h"
#include "ibmfair/measure/mean_curvature.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

/// The smallest meaningful difference of values on a mesh of size 1; smaller differences are
/// rounding errors.
constexpr double least_difference = 1e-6;

struct WeightedValue {
  double value, weight;
};

/// The smallest value such that the values up to it have at least this share of the total weight.
double quantile(const std::vector<WeightedValue>& sorted, double share) {
  double all = 0;
  for (const WeightedValue& entry : sorted) {
    all += entry.weight;
  }
  double sum = 0;
  for (const WeightedValue& entry : sorted) {
    sum += entry.weight;
    if (sum >= share * all) {
      return entry.value;
    }
  }
  return sorted.empty() ? 0 : sorted.back().value;
}

/// The finite values weighted by area, in increasing order; for a diverging field, their absolute
/// values.
std::vector<WeightedValue> values_by_area(const SurfaceField& field, const Eigen::VectorXd& values,
                                          const FieldState& state) {
  const Eigen::VectorXd area = field.place == SurfaceField::Place::vertex
                                   ? Eigen::VectorXd(lumped_vertex_mass(state.X, state.topology))
                                   : triangle_areas(state.X, state.topology.F);
  std::vector<WeightedValue> sorted;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i]) && std::isfinite(area[i])) {
      sorted.push_back({field.diverging ? std::abs(values[i]) : values[i], area[i]});
    }
  }
  std::sort(sorted.begin(), sorted.end(),
            [](const WeightedValue& a, const WeightedValue& b) { return a.value < b.value; });
  return sorted;
}

}  // namespace

Eigen::VectorXd triangle_qualities(const Points& X, const Triangles& F) {
  Eigen::VectorXd qualities(F.rows());
  parallel_for(F.rows(), [&](std::int64_t t) {
    const Vec3 a = X.row(F(t, 0)), b = X.row(F(t, 1)), c = X.row(F(t, 2));
    const double squares = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
    const double double_area = double_area_vector(a, b, c).norm();
    qualities[t] = squares > 0 ? std::min(1.0, 2 * std::numbers::sqrt3 * double_area / squares) : 0;
  });
  return qualities;
}

std::span<const SurfaceField> surface_fields() {
  using Place = SurfaceField::Place;
  static constexpr std::array table{
      SurfaceField{"mean_curvature", "Mean curvature", "1/length", -1, true, Place::vertex, false,
                   [](const FieldState& s) { return mean_curvature(s.X, s.topology); }},
      SurfaceField{
          "normal_displacement", "Displacement along the normal", "length", 1, true, Place::vertex,
          true,
          [](const FieldState& s) { return normal_displacement(*s.before, s.X, s.topology); }},
      SurfaceField{"displacement", "Displacement", "length", 1, false, Place::vertex, true,
                   [](const FieldState& s) { return displacement_length(*s.before, s.X); }},
      SurfaceField{"triangle_quality", "Triangle quality", "", 0, false, Place::triangle, false,
                   [](const FieldState& s) { return triangle_qualities(s.X, s.topology.F); }},
      SurfaceField{
          "energy_density", "Bending energy density", "1/length^2", -2, false, Place::vertex, false,
          [](const FieldState& s) { return energy_density(s.X, s.topology, s.laplacian); }},
  };
  return table;
}

const SurfaceField& surface_field(std::string_view name) {
  return row_named(surface_fields(), "field", name);
}

ValueRange robust_range(const SurfaceField& field, const Eigen::VectorXd& values,
                        const FieldState& state) {
  const std::vector<WeightedValue> sorted = values_by_area(field, values, state);
  const double size = bounding_box_size(state.X).norm();
  const double least = least_difference * std::pow(size, field.dimension);
  const double high = quantile(sorted, 0.99);
  if (field.diverging) {
    return {-std::max(high, least), std::max(high, least)};
  }
  const double low = quantile(sorted, 0.01);
  return {low, std::max(high, low + 2 * least)};
}

}  // namespace ibmfair
