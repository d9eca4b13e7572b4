#include <cstdlib>

#include "commands/program.h"

int main(int argc, char** argv) {
  const int code = ibmfair::commands::run_program(argc, argv);
#ifndef IBMFAIR_SANITIZED  // looks for leaks at the end
  // CHOLMOD may bring OpenBLAS, which waits for its threads when it is unloaded; where memory is
  // short, they never end.
  std::_Exit(code);
#endif
  return code;
}
