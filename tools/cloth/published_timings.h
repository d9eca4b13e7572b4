// [W07] Figure 7, in milliseconds on a Pentium D at 3.4 GHz.
#pragma once

#include <array>

#include "ibmfair/base/types.h"

namespace ibmfair::cloth {

/// Numbers of vertices: four resolutions of the regular mesh and four of the irregular one.
inline constexpr std::array<Index, 8> published_resolutions{400, 1600, 6400, 25600,
                                                            450, 2100, 6500, 22500};

/// Timings of the nonlinear hinge and of quadratic IBM, for one resolution after the other.
struct PublishedTimings {
  std::array<double, 8> hinge, ibm;
};

/// For draping and flag: gradient, Hessian, explicit step, implicit step.
inline constexpr std::array<std::array<PublishedTimings, 4>, 2> published_timings{{
    {{{{0.937, 3.45, 16.4, 66.6, 1.10, 5.43, 17.6, 67.8},
       {0.081, 0.338, 2.19, 9.15, 0.098, 0.494, 2.32, 9.68}},
      {{12.8, 54.2, 218, 890, 15.2, 77.2, 246, 888},
       {0.237, 0.963, 3.87, 15.7, 0.266, 1.28, 3.99, 13.6}},
      {{3.81, 6.64, 27.5, 112, 2.16, 9.53, 31.4, 140},
       {2.63, 2.90, 11.9, 48.8, 0.964, 4.35, 15.2, 76.5}},
      {{28.6, 138, 470, 1730, 33.9, 219, 557, 1880}, {11.0, 62.7, 168, 505, 13.6, 103, 219, 612}}}},
    {{{{0.975, 3.99, 16.0, 64.0, 1.10, 5.43, 17.8, 68.7},
       {0.085, 0.341, 2.14, 8.75, 0.099, 0.490, 2.31, 9.28}},
      {{13.4, 54.8, 212, 849, 15.2, 77.4, 247, 887},
       {0.251, 0.974, 3.79, 14.99, 0.267, 1.30, 3.96, 13.7}},
      {{1.73, 7.05, 27.7, 112, 1.97, 9.80, 32.7, 134},
       {0.780, 3.26, 13.3, 53.4, 0.900, 4.54, 16.1, 70.0}},
      {{27.6, 106, 420, 1680, 33.5, 155, 513, 1880},
       {9.53, 32.9, 127, 490, 12.5, 50.4, 166, 608}}}},
}};

}  // namespace ibmfair::cloth
