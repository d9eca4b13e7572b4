#include "ibmfair/solve/conjugate_gradients_kernels.h"

#include "ibmfair/solve/row_vectors.h"

namespace ibmfair {
namespace {

IBMFAIR_INLINE const float* of_unknown(const float* x, std::int64_t u) {
  return x + 4 * u;
}
IBMFAIR_INLINE float* of_unknown(float* x, std::int64_t u) {
  return x + 4 * u;
}

/// Two numbers, each repeated for the four numbers of one unknown.
IBMFAIR_INLINE Pack<float> spread(const float* two) {
  const Pack<float> a = {two[0], two[1], two[0], two[1], two[0], two[1], two[0], two[1]};
  return __builtin_shufflevector(a, a, 0, 0, 0, 0, 5, 5, 5, 5);
}

IBMFAIR_INLINE double sum_of(const Row4<double>& a) {
  return (a[0] + a[1]) + (a[2] + a[3]);
}

struct MultiplyRows {
  /// The contributions of entries k and k + 1 of a row.
  IBMFAIR_INLINE static Pack<float> product(const DifferenceRows& J, std::int64_t k, const float* p,
                                            const Pack<float>& own) {
    const auto first = load<Row4<float>>(of_unknown(p, J.column[k]));
    const auto second = load<Row4<float>>(of_unknown(p, J.column[k + 1]));
    return spread(J.b + k) * (both_halves(first, second) - own);
  }

  IBMFAIR_INLINE static double run(DifferenceRows J, const float* p, float* q, UnknownRange range) {
    Row4<double> dot = {};
    for (std::int64_t u = range.begin; u < range.end; ++u) {
      const auto own = load<Row4<float>>(of_unknown(p, u));
      const Pack<float> own_twice = both_halves(own, own);
      Pack<float> even = {}, odd = {};  // two independent sums, to shorten the dependency chain
      const std::int64_t first = *J.first++;
      const std::int64_t last = *J.first;
      std::int64_t k = first + 1;
      for (; k + 4 <= last; k += 4) {
        even += product(J, k, p, own_twice);
        odd += product(J, k + 2, p, own_twice);
      }
      if (k < last) {
        even += product(J, k, p, own_twice);
      }
      const Pack<float> both = even + odd;
      const Row4<float> sum = J.b[first] * own + low_half(both) + high_half(both);
      store(of_unknown(q, u), sum);
      dot += __builtin_convertvector(own * sum, Row4<double>);
    }
    return sum_of(dot);
  }
};

struct StepResidual {
  IBMFAIR_INLINE static double run(float alpha, const float* q, const float* N, float* r,
                                   UnknownRange range) {
    Row4<double> norm = {};
    for (std::int64_t u = range.begin; u < range.end; ++u) {
      const Row4<float> left =
          load<Row4<float>>(of_unknown(r, u)) - alpha * load<Row4<float>>(of_unknown(q, u));
      store(of_unknown(r, u), left);
      norm += __builtin_convertvector(N[u] * left * left, Row4<double>);
    }
    return sum_of(norm);
  }
};

struct StepSolution {
  IBMFAIR_INLINE static void run(float alpha, float beta, const float* r, const float* N, float* x,
                                 float* p, UnknownRange range) {
    for (std::int64_t u = range.begin; u < range.end; ++u) {
      const auto direction = load<Row4<float>>(of_unknown(p, u));
      store(of_unknown(x, u), load<Row4<float>>(of_unknown(x, u)) + alpha * direction);
      store(of_unknown(p, u), N[u] * load<Row4<float>>(of_unknown(r, u)) + beta * direction);
    }
  }
};

}  // namespace

double multiply_rows(const DifferenceRows& J, const float* p, float* q, UnknownRange range) {
  return run_kernel<MultiplyRows>(J, p, q, range);
}

double step_residual(float alpha, const float* q, const float* N, float* r, UnknownRange range) {
  return run_kernel<StepResidual>(alpha, q, N, r, range);
}

void step_solution(float alpha, float beta, const float* r, const float* N, float* x, float* p,
                   UnknownRange range) {
  run_kernel<StepSolution>(alpha, beta, r, N, x, p, range);
}

}  // namespace ibmfair
