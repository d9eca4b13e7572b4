// The progress line of a terminal, which is overwritten at every update and cleared at the end.
#pragma once

#include <cstddef>
#include <mutex>
#include <string_view>

namespace ibmfair::commands {

/// The number of columns of the terminal at a file descriptor; 0 if the descriptor is not a
/// terminal or the terminal does not report its width.
std::size_t terminal_columns(int descriptor);

/// Replaces the text in the line of the cursor. The new text must fit into the line. Uses no escape
/// codes, only blanks and carriage returns.
void show_terminal_line(std::string_view text);

/// Clears the line if it shows a text. Async-signal-safe.
void clear_terminal_line();

/// Clears the line, and makes later calls of show_terminal_line() show nothing. Async-signal-safe.
void end_terminal_line();

/// While this object exists, the line stays clear, so that other text can be printed.
class TerminalPause {
 public:
  TerminalPause();

 private:
  std::unique_lock<std::mutex> lock_;
};

}  // namespace ibmfair::commands
