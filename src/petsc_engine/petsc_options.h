// Separates PETSc's options from the program's own arguments.
#pragma once

#include <string>
#include <vector>

namespace ibmfair::petsc {

/// The program's own arguments and PETSc's options.
struct SplitArguments {
  std::vector<std::string> own;
  std::vector<std::string> petsc;
};

/// PETSc's options start with one dash and a word, as `-ksp_rtol 1e-10`; the program's own options
/// have two dashes or one letter. All arguments from the first PETSc option on belong to PETSc.
SplitArguments split_arguments(const std::vector<std::string>& words);

}  // namespace ibmfair::petsc
