// Numbers as colours that keep their order without telling red from green, and in black and white.
#pragma once

#include "ibmfair/picture/image.h"

namespace ibmfair {

/// More is lighter, from dark violet over green to yellow: viridis, by van der Walt and Smith. `t`
/// in [0, 1]; what is beyond takes the colour of the end, NaN is grey.
Rgb sequential_colour(double t);

/// For numbers with a sign: blue, light grey at t = 1/2, red. Both sides darken alike: K. Moreland,
/// "Diverging color maps for scientific visualization", ISVC 2009, from (59, 76, 192) to
/// (180, 4, 38). `t` as above.
Rgb diverging_colour(double t);

}  // namespace ibmfair
