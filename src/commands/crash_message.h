// What the program says when it crashes: enough for a report that its authors can act on.
#pragma once

#include <string_view>

namespace ibmfair::commands {

/// Remembers where the program is ("read", "step 5 of 16"), for crash_message(). Only the first 100
/// bytes are kept. To be called by one thread at a time.
void note_stage(std::string_view stage, std::string_view detail = {});

/// Names version, kernel set, stage and signal, and what to send to whom. Safe in a signal handler:
/// allocates nothing. The text lasts until the next call.
std::string_view crash_message(int signal_number);

}  // namespace ibmfair::commands
