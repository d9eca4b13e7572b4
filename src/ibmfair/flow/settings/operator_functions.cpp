#include "ibmfair/flow/settings/operator_functions.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "ibmfair/base/parallel.h"

namespace ibmfair {
namespace {

/// Of the responses, and of their slopes at 0 relative to that of a response that rises over
/// [0, largest]: smooth shapes consist of small eigenvalues.
constexpr double tolerance = 1e-3;

/// The coefficients of the polynomial of degree `count` - 1 through the values at the Chebyshev
/// nodes cos(pi (j + 1/2) / count).
std::vector<double> interpolate(const std::vector<double>& values) {
  const std::size_t count = values.size();
  std::vector<double> cosines(4 * count), series(count, 0);
  for (std::size_t i = 0; i < cosines.size(); ++i) {
    cosines[i] =
        std::cos(std::numbers::pi * static_cast<double>(i) / (2 * static_cast<double>(count)));
  }
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t j = 0; j < count; ++j) {
      series[k] += values[j] * cosines[k * (2 * j + 1) % cosines.size()];
    }
    series[k] *= (k == 0 ? 1.0 : 2.0) / static_cast<double>(count);
  }
  return series;
}

std::vector<double> nodes(std::size_t count) {
  std::vector<double> x(count);
  for (std::size_t j = 0; j < count; ++j) {
    x[j] = std::cos(std::numbers::pi * (static_cast<double>(j) + 0.5) / static_cast<double>(count));
  }
  return x;
}

/// The value of the series at x in [-1, 1], by C. W. Clenshaw's recurrence.
double value_at(const std::vector<double>& series, double x) {
  double next = 0, last = 0;
  for (std::size_t k = series.size(); k-- > 1;) {
    next = std::exchange(last, 2 * x * last - next + series[k]);
  }
  return series[0] + x * last - next;
}

/// The number of terms after which the rest is small in value and slope.
std::size_t terms_needed(const std::vector<double>& series, double slope) {
  double rest = 0, rest_slope = 0;
  for (std::size_t k = series.size(); k-- > 1;) {
    const auto degree = static_cast<double>(k);
    rest += std::abs(series[k]);
    rest_slope += 2 * degree * degree * std::abs(series[k]);
    if (!(rest < tolerance && rest_slope < 10 * tolerance * slope)) {
      return k + 1;
    }
  }
  return 1;
}

}  // namespace

std::vector<double> chebyshev_series(const Response& response, double largest, std::size_t most) {
  // The slope at 0 times the range.
  const double slope = std::max(1.0, largest * response(1e-6 * largest) / (1e-6 * largest));
  // With fewer nodes than that, none would be where the response rises.
  const double enough = 16 + std::sqrt(slope);
  if (!(enough < 2 * static_cast<double>(most))) {
    return {};
  }
  for (std::size_t count = std::bit_ceil(static_cast<std::size_t>(enough));; count *= 2) {
    std::vector<double> values = nodes(count);
    for (double& value : values) {
      value = response(largest * (value + 1) / 2);
    }
    std::vector<double> series = interpolate(values);
    const std::size_t needed = terms_needed(series, slope);
    if (needed > most) {
      return {};
    }
    if (4 * needed < 3 * count) {
      series.resize(needed);
      series[0] -= value_at(series, -1);
      return series;
    }
  }
}

Points OperatorFunctions::apply_integrated(const std::vector<double>& series,
                                           const Points& b) const {
  std::vector<double> values = nodes(series.size());
  for (double& x : values) {
    x = value_at(series, x) / (largest_ * (x + 1) / 2);
  }
  return apply(interpolate(values), b);
}

/// The sum of series[k] T_k(B) b with B = 2 A / largest - I = (D + h S) / D - 2 I.
Points OperatorFunctions::apply(const std::vector<double>& series, const Points& b) const {
  const std::int64_t n = b.rows();
  const auto unit = static_cast<float>(J_.unit());
  Quads last = Quads::Zero(4, n), present = Quads::Zero(4, n), q(4, n);
  present.topRows<3>() = b.transpose().array().cast<float>();
  Quads result = static_cast<float>(series[0]) * present;
  const Eigen::ArrayXf scale = unit * D_.array().inverse().cast<float>();
  for (std::size_t k = 1; k < series.size(); ++k) {
    J_.apply(present, q);
    const float factor = k == 1 ? 1 : 2;  // T_1 = x T_0, T_(k+1) = 2 x T_k - T_(k-1)
    const auto coefficient = static_cast<float>(series[k]);
    parallel_blocks(n, [&](std::int64_t first, std::int64_t end) {
      for (std::int64_t u = first; u < end; ++u) {
        last.col(u) = factor * (scale[u] * q.col(u) - 2 * present.col(u)) - last.col(u);
        result.col(u) += coefficient * last.col(u);
      }
    });
    last.swap(present);
  }
  return result.topRows<3>().transpose().cast<double>().matrix();
}

}  // namespace ibmfair
