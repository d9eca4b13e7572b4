// The message that the program prints when it crashes, with the facts that a bug report needs.
#pragma once

#include <string_view>

namespace ibmfair::commands {

/// Stores the current stage of the program ("read", "step 5 of 16") for crash_message(). Only the
/// first 100 bytes are kept. May be called by one thread at a time only.
void note_stage(std::string_view stage, std::string_view detail = {});

/// The message names version, kernel set, stage and signal, and tells the user where to send which
/// data. Async-signal-safe: allocates nothing. The text is valid until the next call.
std::string_view crash_message(int signal_number);

}  // namespace ibmfair::commands
