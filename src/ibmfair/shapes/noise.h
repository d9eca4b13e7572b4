// Reproducible noise on vertex positions.
#pragma once

#include <cstdint>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// Adds independent Gaussian noise with the given standard deviation (length) to every coordinate.
void add_noise(Points& X, double standard_deviation, std::uint64_t seed);

}  // namespace ibmfair
