#include "ibmfair/solve/conjugate_gradients_kernels.h"

#include <cstddef>
#include <cstring>

#include "ibmfair/base/simd.h"

// No vector is passed between functions: all are part of kernels.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace ibmfair {
namespace {

// What one unknown has, what two have, and four sums.
using FloatRow __attribute__((vector_size(16))) = float;
using TwoRows __attribute__((vector_size(32))) = float;
using DoubleRow __attribute__((vector_size(32))) = double;

template <class Vector>
IBMFAIR_INLINE Vector load_at(const float* numbers) {
  Vector vector;
  std::memcpy(&vector, numbers, sizeof vector);
  return vector;
}
template <class Vector>
IBMFAIR_INLINE void store_at(float* numbers, const Vector& vector) {
  std::memcpy(numbers, &vector, sizeof vector);
}

IBMFAIR_INLINE const float* of_unknown(const float* x, std::int64_t u) {
  return x + 4 * u;
}
IBMFAIR_INLINE float* of_unknown(float* x, std::int64_t u) {
  return x + 4 * u;
}

IBMFAIR_INLINE TwoRows side_by_side(const FloatRow& low, const FloatRow& high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}
IBMFAIR_INLINE FloatRow sum_of(const TwoRows& a) {
  return __builtin_shufflevector(a, a, 0, 1, 2, 3) + __builtin_shufflevector(a, a, 4, 5, 6, 7);
}

/// Two numbers, each for all that one unknown has.
IBMFAIR_INLINE TwoRows spread(const float* two) {
  const TwoRows a = {two[0], two[1], two[0], two[1], two[0], two[1], two[0], two[1]};
  return __builtin_shufflevector(a, a, 0, 0, 0, 0, 5, 5, 5, 5);
}

IBMFAIR_INLINE double sum_of(const DoubleRow& a) {
  return (a[0] + a[1]) + (a[2] + a[3]);
}

struct MultiplyRows {
  /// Of entries k and k + 1 of a row.
  IBMFAIR_INLINE static TwoRows product(const DifferenceRows& J, std::int64_t k, const float* p,
                                        const TwoRows& own) {
    const auto first = load_at<FloatRow>(of_unknown(p, J.column[k]));
    const auto second = load_at<FloatRow>(of_unknown(p, J.column[k + 1]));
    return spread(J.b + k) * (side_by_side(first, second) - own);
  }

  IBMFAIR_INLINE static double run(DifferenceRows J, const float* p, float* q, UnknownRange range) {
    DoubleRow dot = {};
    for (std::int64_t u = range.begin; u < range.end; ++u) {
      const auto own = load_at<FloatRow>(of_unknown(p, u));
      const TwoRows own_twice = side_by_side(own, own);
      TwoRows even = {}, odd = {};  // two sums: a single one would wait for itself
      std::int64_t k = J.first[u];
      const std::int64_t last = J.first[u + 1];
      for (; k + 4 <= last; k += 4) {
        even += product(J, k, p, own_twice);
        odd += product(J, k + 2, p, own_twice);
      }
      if (k < last) {
        even += product(J, k, p, own_twice);
      }
      const FloatRow sum = J.a[u] * own + sum_of(even + odd);
      store_at(of_unknown(q, u), sum);
      dot += __builtin_convertvector(own * sum, DoubleRow);
    }
    return sum_of(dot);
  }
};

struct StepResidual {
  IBMFAIR_INLINE static double run(float alpha, const float* q, const float* N, float* r,
                                   UnknownRange range) {
    DoubleRow norm = {};
    for (std::int64_t u = range.begin; u < range.end; ++u) {
      const FloatRow left =
          load_at<FloatRow>(of_unknown(r, u)) - alpha * load_at<FloatRow>(of_unknown(q, u));
      store_at(of_unknown(r, u), left);
      norm += __builtin_convertvector(N[u] * left * left, DoubleRow);
    }
    return sum_of(norm);
  }
};

struct StepSolution {
  IBMFAIR_INLINE static void run(float alpha, float beta, const float* r, const float* N, float* x,
                                 float* p, UnknownRange range) {
    for (std::int64_t u = range.begin; u < range.end; ++u) {
      const auto direction = load_at<FloatRow>(of_unknown(p, u));
      store_at(of_unknown(x, u), load_at<FloatRow>(of_unknown(x, u)) + alpha * direction);
      store_at(of_unknown(p, u), N[u] * load_at<FloatRow>(of_unknown(r, u)) + beta * direction);
    }
  }
};

}  // namespace

double multiply_rows(const DifferenceRows& J, const float* p, float* q, UnknownRange range) {
  return run<MultiplyRows>(J, p, q, range);
}

double step_residual(float alpha, const float* q, const float* N, float* r, UnknownRange range) {
  return run<StepResidual>(alpha, q, N, r, range);
}

void step_solution(float alpha, float beta, const float* r, const float* N, float* x, float* p,
                   UnknownRange range) {
  run<StepSolution>(alpha, beta, r, N, x, p, range);
}

}  // namespace ibmfair
