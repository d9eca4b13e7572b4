#include "ibmfair/measure/statistics.h"

#include <cmath>
#include <limits>

namespace ibmfair {

Statistics summarise(const Eigen::VectorXd& values) {
  Statistics result;
  if (values.size() == 0) {
    return result;
  }
  const Eigen::VectorXd known = values.unaryExpr(
      [](double v) { return std::isnan(v) ? std::numeric_limits<double>::infinity() : v; });
  Eigen::Index where = 0;
  result.max = known.maxCoeff(&where);
  result.where = static_cast<Index>(where);
  result.mean = known.mean();
  // Squares of very small or large values would leave the range of a double.
  result.rms = result.max > 0.0 && std::isfinite(result.max)
                   ? result.max * std::sqrt((known / result.max).squaredNorm() /
                                            static_cast<double>(known.size()))
                   : result.max;
  return result;
}

}  // namespace ibmfair
