// Turns the error codes of PETSc and MPI into exceptions.
#pragma once

#include <petscsys.h>

namespace ibmfair::petsc {

/// If `code` is an error, throws OutOfMemory, or std::runtime_error with PETSc's message.
void check(PetscErrorCode code);

}  // namespace ibmfair::petsc
