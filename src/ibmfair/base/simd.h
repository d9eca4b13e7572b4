// Kernels that are written once, with the compiler's own vectors, and compiled twice: for the
// instructions that every x86-64 processor has, and for AVX2 with FMA. run_kernel() chooses between
// the two when the program runs. Results do not depend on the choice, because vector operations
// round lane by lane and nothing is fused (-ffp-contract=off), except in the files that
// CMakeLists.txt compiles with -ffp-contract=fast: there the AVX2 version adds products without
// rounding them first.
#pragma once

#include <cstring>

#include "ibmfair/base/instruction_set.h"

/// Functions that are part of such a kernel: they become part of all of its versions.
#define IBMFAIR_INLINE __attribute__((always_inline)) inline
/// IBMFAIR_INLINE for lambdas; it stands behind their parameters.
#define IBMFAIR_INLINE_LAMBDA __attribute__((always_inline))

// Elsewhere the compiler makes of the vectors what the machine has.
#if defined(__x86_64__) && defined(__GNUC__)
#define IBMFAIR_HAS_AVX_KERNELS 1
#define IBMFAIR_TARGET(set) [[gnu::target(set)]]
#else
#define IBMFAIR_HAS_AVX_KERNELS 0
#define IBMFAIR_TARGET(set)
#endif

// GCC warns of vectors that are wider than the baseline's registers and cross a border between
// functions; every function of a kernel is inlined, so that they never do.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace ibmfair {

/// The numbers from `numbers` on, which need be aligned as single numbers only. Vectors come from
/// memory and go there by these two alone: a pointer or a reference to a vector type promises the
/// alignment of whole vectors, and the compiler takes the promise.
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

/// Kernel::run(arguments...), an IBMFAIR_INLINE function, as compiled for kernel_set().
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
