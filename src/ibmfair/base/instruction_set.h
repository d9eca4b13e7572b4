// Which of their two versions the vectorized kernels (base/simd.h) run in.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace ibmfair {

/// What a kernel is compiled for. `baseline`: what every processor of the architecture has.
/// `avx2`: AVX2 and FMA, on x86-64.
enum class InstructionSet : std::uint8_t { baseline, avx2 };
inline constexpr std::array<std::string_view, 2> instruction_set_names{"baseline", "avx2"};

/// The best that this processor has.
InstructionSet best_instruction_set();

/// What kernels use: the best there is, unless chosen otherwise.
InstructionSet kernel_set();

/// Its name.
std::string_view kernel_set_name();

/// Chooses what kernels use from now on, to see whether a result depends on it. Throws BadOption
/// where the processor lacks the set: nothing else runs in its place.
void choose_kernel_set(InstructionSet set);

/// The environment variable that names the kernel set for a run of the program or of the tests.
inline constexpr const char* kernels_variable = "IBMFAIR_KERNELS";

/// Chooses the set that `kernels_variable` names; does nothing where it is unset or empty. Throws
/// BadOption where the name is none of `instruction_set_names`, or the processor lacks the set.
void choose_kernel_set_by_environment();

}  // namespace ibmfair
