// Which of their versions the vectorized kernels (base/lanes.h) run in.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace ibmfair {

/// What a kernel is compiled for; each has all that those before it have.
enum class InstructionSet : std::uint8_t { baseline, avx2, avx512 };
inline constexpr std::array<std::string_view, 3> instruction_set_names{"baseline", "avx2",
                                                                       "avx512"};

/// The best that this processor has.
InstructionSet best_instruction_set();

/// What kernels use: the best there is, unless chosen otherwise.
InstructionSet kernel_set();

/// For showing that the bytes are the same: chooses what kernels use, at most the best.
void choose_kernel_set(InstructionSet set);

}  // namespace ibmfair
