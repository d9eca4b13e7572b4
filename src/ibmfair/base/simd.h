// Kernels compiled once for every kind of processor, the best one chosen when the program starts.
// Results do not depend on the choice: vector operations round lane by lane, and nothing is fused
// (-ffp-contract=off).
#pragma once

// The choice is made by the dynamic linker, before sanitizers are ready.
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define IBMFAIR_FOR_EVERY_PROCESSOR __attribute__((target_clones("default", "avx2")))
#else
#define IBMFAIR_FOR_EVERY_PROCESSOR
#endif

/// Functions that such kernels share: they become part of each of its versions.
#define IBMFAIR_INLINE __attribute__((always_inline)) inline
