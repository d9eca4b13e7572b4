#include <cstdlib>

#include "commands/program.h"

int main(int argc, char** argv) {
  const int code = ibmfair::commands::run_program(argc, argv);
#ifndef __SANITIZE_ADDRESS__  // looks for leaks at the end
  // OpenBLAS, when it is unloaded, waits for its threads, which never end where memory is short.
  std::_Exit(code);
#endif
  return code;
}
