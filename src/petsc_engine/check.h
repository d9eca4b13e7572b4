// What PETSc and MPI report as codes, as exceptions.
#pragma once

#include <petscsys.h>

namespace ibmfair::petsc {

/// Throws OutOfMemory, or std::runtime_error with what PETSc has to say.
void check(PetscErrorCode code);

}  // namespace ibmfair::petsc
