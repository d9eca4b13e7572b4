// The line of a terminal that shows progress: drawn over again, and never left behind.
#pragma once

#include <cstddef>
#include <mutex>
#include <string_view>

namespace ibmfair::commands {

/// The columns of the terminal that a file descriptor is; 0 where it is none, or does not say.
std::size_t terminal_columns(int descriptor);

/// Shows the text, which has to fit, in the line of the cursor, in place of what was shown before.
/// It takes no escape codes, only blanks and carriage returns.
void show_terminal_line(std::string_view text);

/// Clears the line where something is shown. Safe in a signal handler.
void clear_terminal_line();

/// Clears the line, and shows nothing from here on. Safe in a signal handler.
void end_terminal_line();

/// While it exists, the line is clear for something else to be printed.
class TerminalPause {
 public:
  TerminalPause();

 private:
  std::unique_lock<std::mutex> lock_;
};

}  // namespace ibmfair::commands
