// Reproducible random numbers.
#pragma once

#include <array>
#include <cstdint>

namespace ibmfair {

/// Random numbers that are the same on every platform, for ever: integers from xoshiro256**
/// (Blackman, Vigna: "Scrambled linear pseudorandom number generators", ACM TOMS 47, 2021), seeded
/// by splitmix64.
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed);

  std::uint64_t integer();

  /// Uniform in [0, 1), a multiple of 2^-53.
  double uniform();

  /// A standard normal number. Algorithm N of Karney, "Sampling exactly from the normal
  /// distribution", ACM TOMS 42 (2016). The algorithm uses only comparisons, one sum and one
  /// quotient, so the result does not depend on a platform's logarithm or rounding.
  double normal();

 private:
  /// True with probability exp(-x * q), x and q in [0, 1] (von Neumann's method, which uses the
  /// parity of the length of a decreasing run of uniform numbers).
  bool exponential_trial(double x, double q);

  std::array<std::uint64_t, 4> state_{};
};

}  // namespace ibmfair
