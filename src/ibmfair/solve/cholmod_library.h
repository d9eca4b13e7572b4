// CHOLMOD's shared library, which is loaded when it is first used: with the BLAS that it brings, it
// takes several times as long to load as this program.
#pragma once

#include <vector>

#include <cholmod.h>

#include "ibmfair/base/version.h"

namespace ibmfair {

/// The functions of CHOLMOD that are used here, as its manual describes them.
struct CholmodFunctions {
  decltype(&cholmod_l_start) start;
  decltype(&cholmod_l_finish) finish;
  decltype(&cholmod_l_analyze_p) analyze_p;
  decltype(&cholmod_l_factorize) factorize;
  decltype(&cholmod_l_solve2) solve2;
  decltype(&cholmod_l_free_factor) free_factor;
  decltype(&cholmod_l_free_dense) free_dense;
  decltype(&cholmod_version) version;
};

/// Loads CHOLMOD with the first call. CHOLMOD and its BLAS are told to use one thread, unless the
/// environment tells them otherwise (OPENBLAS_NUM_THREADS and the like; see cholmod_library.cpp):
/// with more threads, the BLAS adds in another order, and results depend on their number. For a
/// process that had loaded the BLAS or OpenMP before, this has no effect. While CHOLMOD is loaded,
/// no other thread may change the environment. Throws BadOption if CHOLMOD cannot be loaded, and
/// OutOfMemory if the address space is limited and too small for its BLAS.
const CholmodFunctions& cholmod_functions();

/// Loads CHOLMOD, and returns its version and that of the BLAS. Throws as cholmod_functions() does.
std::vector<Component> cholmod_components();

}  // namespace ibmfair
