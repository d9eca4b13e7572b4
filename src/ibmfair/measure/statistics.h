// What a list of magnitudes comes down to.
#pragma once

#include "ibmfair/base/types.h"

namespace ibmfair {

/// Mean, root of the mean square, and largest of non-negative values, and where the largest is.
struct Statistics {
  double mean = 0.0;
  double rms = 0.0;
  double max = 0.0;
  Index where = -1;  ///< -1: there were no values
};

/// NaN values count as infinitely large.
Statistics summarise(const Eigen::VectorXd& values);

}  // namespace ibmfair
