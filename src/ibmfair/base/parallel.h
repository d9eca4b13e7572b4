// Loops over all threads whose results do not depend on the number of threads.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace ibmfair {

/// Loops shorter than this run on one thread: waking the others would take longer.
inline constexpr std::int64_t worth_sharing = 16384;

/// Calls body(i) for every i in 0 .. count - 1, in parallel; bodies must not write the same place.
template <class Body>
void parallel_for(std::int64_t count, Body&& body) {
#pragma omp parallel for schedule(static) if (count >= worth_sharing)
  for (std::int64_t i = 0; i < count; ++i) {
    body(i);
  }
}

/// `zero` plus the sum of body(i) over 0 .. count - 1. Blocks of fixed size are summed first and
/// then added in order, so that the rounding, too, is the same for any number of threads.
template <class Value, class Body>
Value parallel_sum(std::int64_t count, const Value& zero, Body&& body) {
  constexpr std::int64_t block = 1024;
  const std::int64_t blocks = (count + block - 1) / block;
  std::vector<Value> partial(static_cast<std::size_t>(blocks), zero);
#pragma omp parallel for schedule(static) if (count >= worth_sharing)
  for (std::int64_t b = 0; b < blocks; ++b) {
    Value sum = zero;
    for (std::int64_t i = b * block; i < std::min(count, (b + 1) * block); ++i) {
      sum += body(i);
    }
    partial[static_cast<std::size_t>(b)] = sum;
  }
  Value sum = zero;
  for (const Value& part : partial) {
    sum += part;
  }
  return sum;
}

/// The same for plain numbers.
template <class Body>
double parallel_sum(std::int64_t count, Body&& body) {
  return parallel_sum(count, 0.0, body);
}

}  // namespace ibmfair
