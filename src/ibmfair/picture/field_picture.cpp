#include "ibmfair/picture/field_picture.h"

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "ibmfair/picture/legend.h"

namespace ibmfair {
namespace {

/// The mean over the corners with a finite value; NaN if there is none.
Eigen::VectorXd triangle_values(const SurfaceField& field, const Eigen::VectorXd& values,
                                const Triangles& F) {
  if (field.place == SurfaceField::Place::triangle) {
    return values;
  }
  Eigen::VectorXd means(F.rows());
  for (Eigen::Index t = 0; t < F.rows(); ++t) {
    double sum = 0;
    int count = 0;
    for (const Index v : F.row(t)) {
      if (std::isfinite(values[v])) {
        sum += values[v];
        ++count;
      }
    }
    means[t] = count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
  }
  return means;
}

std::string title_of(const SurfaceField& field) {
  std::string title(field.title);
  return field.unit.empty() ? title : title + ", " + std::string(field.unit);
}

}  // namespace

Image render_field(const SurfaceField& field, std::span<const FieldState> states,
                   const RenderOptions& options) {
  std::vector<Eigen::VectorXd> values;
  for (const FieldState& state : states) {
    const bool has_values = !field.needs_before || state.before != nullptr;
    values.push_back(has_values ? field.values(state) : Eigen::VectorXd());
  }
  const ValueRange range =
      states.empty() ? ValueRange{} : robust_range(field, values.back(), states.back());
  const ColourScale scale{title_of(field), range.low, range.high, field.diverging};

  std::vector<PaintedMesh> meshes;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Triangles& F = states[i].topology.F;
    meshes.push_back({states[i].X, F});
    if (values[i].size() > 0) {
      for (const double value : triangle_values(field, values[i], F)) {
        meshes.back().paint.triangle.push_back(scale.colour(value));
      }
    }
  }
  const Image picture = render_side_by_side(meshes, options);
  const std::array<Image, 2> parts{picture, draw_legend(scale, picture.width, options.background)};
  return stacked(parts, options.background);
}

}  // namespace ibmfair
