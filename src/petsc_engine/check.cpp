#include "petsc_engine/check.h"

#include <stdexcept>
#include <string>

#include "ibmfair/base/errors.h"

namespace ibmfair::petsc {

void check(PetscErrorCode code) {
  if (code == 0) {
    return;
  }
  if (code == PETSC_ERR_MEM) {
    throw OutOfMemory("not enough memory for this mesh on this many ranks");
  }
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw std::runtime_error("PETSc: " + std::string(text == nullptr ? "unknown error" : text));
}

}  // namespace ibmfair::petsc
