// Runs the tests with the kernels that the environment asks for.
#include <gtest/gtest.h>

#include "ibmfair/base/instruction_set.h"

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ibmfair::choose_kernel_set_by_environment();
  return RUN_ALL_TESTS();
}
