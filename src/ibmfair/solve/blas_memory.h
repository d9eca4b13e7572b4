// The working memory of OpenBLAS.
#pragma once

namespace ibmfair {

/// OpenBLAS takes 128 MB of address space for each thread that calls it, when it first does, and
/// tries for ever where it does not get them. This takes them before, for as many threads as there
/// are now; what it took once it keeps. Throws OutOfMemory where there is too little.
void reserve_blas_memory();

}  // namespace ibmfair
