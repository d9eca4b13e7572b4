// Statistics of a list of magnitudes.
#pragma once

#include "ibmfair/base/types.h"

namespace ibmfair {

/// Mean, root mean square and maximum of non-negative values, and the index of the maximum.
struct Statistics {
  double mean = 0.0;
  double rms = 0.0;
  double max = 0.0;
  Index where = -1;  ///< -1: there were no values
};

/// NaN values count as infinitely large.
Statistics summarise(const Eigen::VectorXd& values);

}  // namespace ibmfair
