// Colour maps that keep the order of the numbers also for viewers who cannot tell red from green,
// and in black and white.
#pragma once

#include "ibmfair/picture/image.h"

namespace ibmfair {

/// Larger values are lighter, from dark violet over green to yellow: viridis, by van der Walt and
/// Smith. `t` is in [0, 1]; values outside get the colour of the nearer end, NaN is grey.
Rgb sequential_colour(double t);

/// For signed values: blue, light grey at t = 1/2, red; both sides darken equally. K. Moreland,
/// "Diverging color maps for scientific visualization", ISVC 2009, from (59, 76, 192) to (180, 4,
/// 38). `t` as above.
Rgb diverging_colour(double t);

}  // namespace ibmfair
