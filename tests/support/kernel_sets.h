// For tests that need a certain set of kernels, whatever the processor and the environment would
// choose.
#pragma once

#include <gtest/gtest.h>

#include "ibmfair/base/instruction_set.h"

/// Skips the test on a processor that cannot run the set of kernels that the test is about.
#define SKIP_WITHOUT_KERNEL_SET(set) \
  if (ibmfair::best_instruction_set() < (set)) GTEST_SKIP() << "this processor cannot run it"

namespace ibmfair::test {

/// The kernels of this set are used while this object exists. Throws BadOption if the processor
/// lacks the instructions of the set.
class WithKernelSet {
 public:
  explicit WithKernelSet(InstructionSet set) : before_(kernel_set()) { choose_kernel_set(set); }
  ~WithKernelSet() { choose_kernel_set(before_); }
  WithKernelSet(const WithKernelSet&) = delete;
  WithKernelSet& operator=(const WithKernelSet&) = delete;

 private:
  InstructionSet before_;
};

}  // namespace ibmfair::test
