#include "ibmfair/base/random_numbers.h"

#include <bit>

namespace ibmfair {

RandomNumbers::RandomNumbers(std::uint64_t seed) {
  for (std::uint64_t& word : state_) {
    seed += 0x9e3779b97f4a7c15U;
    std::uint64_t z = seed;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    word = z ^ (z >> 31U);
  }
}

std::uint64_t RandomNumbers::integer() {
  const std::uint64_t result = std::rotl(state_[1] * 5, 7) * 9;
  const std::uint64_t shifted = state_[1] << 17U;
  state_[2] ^= state_[0];
  state_[3] ^= state_[1];
  state_[1] ^= state_[2];
  state_[0] ^= state_[3];
  state_[2] ^= shifted;
  state_[3] = std::rotl(state_[3], 45);
  return result;
}

double RandomNumbers::uniform() {
  return static_cast<double>(integer() >> 11U) * 0x1p-53;
}

bool RandomNumbers::exponential_trial(double x, double q) {
  bool even = true;
  double last = x;
  while (true) {
    const double next = uniform();
    if (!(next < last) || !(uniform() < q)) {
      return even;
    }
    last = next;
    even = !even;
  }
}

double RandomNumbers::normal() {
  while (true) {
    // N1: k with probability proportional to exp(-k / 2).
    int k = 0;
    while (exponential_trial(0.5, 1.0)) {
      ++k;
    }
    // N2: accept with probability exp(-k (k - 1) / 2).
    bool accepted = true;
    for (int trial = 0; accepted && trial < k * (k - 1); ++trial) {
      accepted = exponential_trial(0.5, 1.0);
    }
    // N3, N4: x in [0, 1), accepted with probability exp(-x (2 k + x) / 2).
    const double x = uniform();
    const double q = (static_cast<double>(2 * k) + x) / static_cast<double>(2 * k + 2);
    for (int trial = 0; accepted && trial <= k; ++trial) {
      accepted = exponential_trial(x, q);
    }
    if (accepted) {
      const double magnitude = static_cast<double>(k) + x;
      return (integer() >> 63U) != 0 ? -magnitude : magnitude;
    }
  }
}

}  // namespace ibmfair
