#include "commands/program.h"

int main(int argc, char** argv) {
  return ibmfair::commands::run_program(argc, argv);
}
