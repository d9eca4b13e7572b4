#include "ibmfair/base/instruction_set.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"

namespace ibmfair {
namespace {

std::string_view name_of(InstructionSet set) {
  return instruction_set_names[static_cast<std::size_t>(set)];
}

std::atomic<InstructionSet>& chosen() {
  static std::atomic<InstructionSet> set{best_instruction_set()};
  return set;
}

}  // namespace

InstructionSet best_instruction_set() {
#if defined(__x86_64__) && defined(__GNUC__)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    return InstructionSet::avx2;
  }
#endif
  return InstructionSet::baseline;
}

InstructionSet kernel_set() {
  return chosen().load(std::memory_order_relaxed);
}

std::string_view kernel_set_name() {
  return name_of(kernel_set());
}

void choose_kernel_set(InstructionSet set) {
  if (set > best_instruction_set()) {
    throw BadOption(fmt::format("this processor cannot run the kernels for {}", name_of(set)));
  }
  chosen().store(set, std::memory_order_relaxed);
}

void choose_kernel_set_by_environment() {
  const char* given = std::getenv(kernels_variable);
  if (given == nullptr || *given == '\0') return;
  const auto& names = instruction_set_names;
  const auto name = std::find(names.begin(), names.end(), given);
  if (name == names.end()) {
    throw BadOption(
        fmt::format("{}: '{}' is neither {}", kernels_variable, given, fmt::join(names, " nor ")));
  }
  try {
    choose_kernel_set(static_cast<InstructionSet>(name - names.begin()));
  } catch (const BadOption& error) {
    throw BadOption(fmt::format("{}: {}", kernels_variable, error.what()));
  }
}

}  // namespace ibmfair
