// Selects which of the two compiled versions of the vectorized kernels (base/simd.h) runs.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace ibmfair {

/// The instructions that a kernel is compiled for. `baseline`: those that every processor of the
/// architecture has. `avx2`: AVX2 and FMA, on x86-64.
enum class InstructionSet : std::uint8_t { baseline, avx2 };
inline constexpr std::array<std::string_view, 2> instruction_set_names{"baseline", "avx2"};

/// The best instruction set that this processor supports.
InstructionSet best_instruction_set();

/// The instruction set that kernels use: the best supported one, unless another was chosen.
InstructionSet kernel_set();

/// The name of kernel_set().
std::string_view kernel_set_name();

/// Sets the instruction set that kernels use from now on, for testing whether a result depends on
/// it. Throws BadOption if the processor lacks the set; no other set is used instead.
void choose_kernel_set(InstructionSet set);

/// The environment variable that names the kernel set for a run of the program or of the tests.
inline constexpr const char* kernels_variable = "IBMFAIR_KERNELS";

/// Chooses the instruction set that the environment variable `kernels_variable` names; does nothing
/// if the variable is unset or empty. Throws BadOption if the name is not in
/// `instruction_set_names` or the processor lacks the set.
void choose_kernel_set_by_environment();

}  // namespace ibmfair
