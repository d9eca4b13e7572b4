#include "ibmfair/shapes/jitter.h"

#include <fmt/format.h>

#include "ibmfair/base/errors.h"

namespace ibmfair {
namespace {

double mean_side(const Points& X, const Triangles& F) {
  double sum = 0;
  for (Index t = 0; t < F.rows(); ++t) {
    for (int i = 0; i < 3; ++i) {
      sum += (X.row(F(t, i)) - X.row(F(t, (i + 1) % 3))).norm();
    }
  }
  return sum / (3.0 * static_cast<double>(F.rows()));
}

}  // namespace

RandomOffsets::RandomOffsets(const Jitter& jitter) : amount_(jitter.amount), random_(jitter.seed) {
  if (!(amount_ >= 0 && amount_ < 0.5)) {
    throw BadOption(
        fmt::format("--jitter: {} is out of range; it must be at least 0 and below 0.5", amount_));
  }
}

void jitter_on_unit_sphere(Points& X, const Triangles& F, const Jitter& jitter) {
  RandomOffsets offsets(jitter);
  if (jitter.amount == 0) {
    return;
  }
  const double edge = mean_side(X, F);
  for (Index v = 0; v < X.rows(); ++v) {
    const double x = offsets.next(), y = offsets.next(), z = offsets.next();
    X.row(v) = (X.row(v) + edge * Eigen::RowVector3d(x, y, z)).normalized();
  }
}

}  // namespace ibmfair
