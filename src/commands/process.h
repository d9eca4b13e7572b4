// What the process owes its surroundings: signals, standard descriptors, memory.
#pragma once

namespace ibmfair::commands {

/// The variable in the environment of a process that must not outlive the one that started it, with
/// that one's id.
inline constexpr const char* parent_variable = "IBMFAIR_PARENT";

/// Sets up how signals are met (commands/signals.h), and makes sure that no file that is opened
/// later can take the place of a standard stream that the caller closed. A process that belongs to
/// a batch ends with it, however that ends. What the process frees it keeps,
/// and its threads are those of our loops alone.
void prepare_process();

}  // namespace ibmfair::commands
