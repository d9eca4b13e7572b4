// Which of the program's arguments are PETSc's.
#pragma once

#include <string>
#include <vector>

namespace ibmfair::petsc {

/// Arguments that have been told apart.
struct SplitArguments {
  std::vector<std::string> own;
  std::vector<std::string> petsc;
};

/// PETSc's options start with one dash and a word, `-ksp_rtol 1e-10`; our own have two dashes or
/// one letter. All that follows the first of PETSc's is PETSc's.
SplitArguments split_arguments(const std::vector<std::string>& words);

}  // namespace ibmfair::petsc
