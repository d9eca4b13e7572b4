#include "ibmfair/base/instruction_set.h"

#include <algorithm>
#include <atomic>

namespace ibmfair {
namespace {

std::atomic<InstructionSet>& chosen() {
  static std::atomic<InstructionSet> set{best_instruction_set()};
  return set;
}

}  // namespace

InstructionSet best_instruction_set() {
#if defined(__x86_64__) && defined(__GNUC__)
  __builtin_cpu_init();
  // The first processors with AVX-512 lower their clock where it is used; VBMI2 came after that.
  if (__builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vbmi2")) {
    return InstructionSet::avx512;
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    return InstructionSet::avx2;
  }
#endif
  return InstructionSet::baseline;
}

InstructionSet kernel_set() {
  return chosen().load(std::memory_order_relaxed);
}

void choose_kernel_set(InstructionSet set) {
  chosen().store(std::min(set, best_instruction_set()), std::memory_order_relaxed);
}

}  // namespace ibmfair
