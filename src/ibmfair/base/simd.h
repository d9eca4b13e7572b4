// Kernels that are written once, with the vector types of the compiler, and compiled twice: for the
// instructions that every x86-64 processor has, and for AVX2 with FMA. run_kernel() chooses between
// the two versions at run time. The results do not depend on the choice, because vector operations
// round lane by lane and multiply-adds are not fused (-ffp-contract=off). The exceptions are the
// files that CMakeLists.txt compiles with -ffp-contract=fast: there the AVX2 version adds products
// without rounding them first.
#pragma once

#include <cstring>

#include "ibmfair/base/instruction_set.h"

/// Marks a function that is part of such a kernel; the function is inlined into both versions of
/// it.
#define IBMFAIR_INLINE __attribute__((always_inline)) inline
/// IBMFAIR_INLINE for lambdas; written after the parameters of the lambda.
#define IBMFAIR_INLINE_LAMBDA __attribute__((always_inline))

// On other platforms there is one version, and the compiler maps the vectors to the machine's
// instructions.
#if defined(__x86_64__) && defined(__GNUC__)
#define IBMFAIR_HAS_AVX_KERNELS 1
#define IBMFAIR_TARGET(set) [[gnu::target(set)]]
#else
#define IBMFAIR_HAS_AVX_KERNELS 0
#define IBMFAIR_TARGET(set)
#endif

// GCC warns when a vector that is wider than the registers of the baseline is passed to or returned
// from a function. This cannot happen here, because every function of a kernel is inlined.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace ibmfair {

/// Reads a vector from `numbers`, which only need the alignment of single numbers. Use load() and
/// store() for every access to vectors in memory: a pointer or reference to a vector type promises
/// the alignment of a whole vector, and the compiler relies on the promise.
template <class Vector, class Real>
IBMFAIR_INLINE Vector load(const Real* numbers) {
  Vector vector;
  std::memcpy(&vector, numbers, sizeof vector);
  return vector;
}
template <class Vector, class Real>
IBMFAIR_INLINE void store(Real* numbers, const Vector& vector) {
  std::memcpy(numbers, &vector, sizeof vector);
}

namespace simd_detail {

template <class Kernel, class... Arguments>
auto run_baseline(Arguments... arguments) {
  return Kernel::run(arguments...);
}

template <class Kernel, class... Arguments>
IBMFAIR_TARGET("avx2,fma")
auto run_avx2(Arguments... arguments) {
  return Kernel::run(arguments...);
}

}  // namespace simd_detail

/// Calls Kernel::run(arguments...), an IBMFAIR_INLINE function, in the version compiled for
/// kernel_set().
template <class Kernel, class... Arguments>
auto run_kernel(Arguments... arguments) {
#if IBMFAIR_HAS_AVX_KERNELS
  if (kernel_set() == InstructionSet::avx2) {
    return simd_detail::run_avx2<Kernel>(arguments...);
  }
#endif
  return simd_detail::run_baseline<Kernel>(arguments...);
}

}  // namespace ibmfair
