#include "ibmfair/picture/visibility.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ibmfair {
namespace {

/// A function that is linear over the picture: value(column, row) = c + x * column + y * row.
struct Linear {
  double c, x, y;

  double at(double column, double row) const { return c + x * column + y * row; }
};

/// Twice the signed area of (a, b, p) for a point p of the picture.
Linear edge_function(const Projected& a, const Projected& b) {
  return {a.column * b.row - a.row * b.column, a.row - b.row, b.column - a.column};
}

/// The pixels whose centres lie between two coordinates, clipped to 0 .. size - 1.
struct Range {
  int first, last;

  Range(double low, double high, int size)
      : first(static_cast<int>(std::clamp(std::ceil(low - 0.5), 0.0, static_cast<double>(size)))),
        last(static_cast<int>(
            std::clamp(std::floor(high - 0.5), -1.0, static_cast<double>(size - 1)))) {}
};

void draw(Index triangle, const Projected& a, const Projected& b, const Projected& c,
          Visibility& seen) {
  const Linear ab = edge_function(a, b);
  const Linear bc = edge_function(b, c);
  const Linear ca = edge_function(c, a);
  const double area = ab.at(c.column, c.row);
  if (!(std::abs(area) > 0.0) || !std::isfinite(area)) {
    return;
  }

  const auto [left, right] = std::minmax({a.column, b.column, c.column});
  const auto [top, bottom] = std::minmax({a.row, b.row, c.row});
  const Range columns(left, right, seen.width);
  const Range rows(top, bottom, seen.height);
  const double inverse_area = 1.0 / area;
  for (int row = rows.first; row <= rows.last; ++row) {
    for (int column = columns.first; column <= columns.last; ++column) {
      const double x = column + 0.5;
      const double y = row + 0.5;
      const double wa = bc.at(x, y) * inverse_area;
      const double wb = ca.at(x, y) * inverse_area;
      const double wc = ab.at(x, y) * inverse_area;
      if (!(wa >= 0.0 && wb >= 0.0 && wc >= 0.0)) {
        continue;
      }
      const auto nearness = static_cast<float>(wa * a.nearness + wb * b.nearness + wc * c.nearness);
      const std::size_t pixel = seen.pixel(column, row);
      if (nearness > seen.nearness[pixel]) {
        seen.nearness[pixel] = nearness;
        seen.triangle[pixel] = triangle;
      }
    }
  }
}

}  // namespace

Visibility find_visible(const Points& X, const Triangles& F, const Camera& camera, int width,
                        int height) {
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  Visibility seen{width, height, std::vector<Index>(pixels, Visibility::nothing),
                  std::vector<float>(pixels, std::numeric_limits<float>::lowest())};

  std::vector<Projected> projected;
  projected.reserve(static_cast<std::size_t>(X.rows()));
  for (const auto& x : X.rowwise()) {
    projected.push_back(camera.project(x.transpose()));
  }
  for (Eigen::Index t = 0; t < F.rows(); ++t) {
    draw(static_cast<Index>(t), projected[F(t, 0)], projected[F(t, 1)], projected[F(t, 2)], seen);
  }
  return seen;
}

}  // namespace ibmfair
