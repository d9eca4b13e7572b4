// Runs the program on a terminal of its own, as it runs for a person who watches it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "support/run_program.h"

namespace ibmfair::test {

struct TerminalOptions {
  int columns = 80;
  std::string directory = {};                 ///< working directory; empty: the test's own
  std::vector<std::string> environment = {};  ///< `NAME=value`, on top of the test's own
  /// Ctrl-C is typed as soon as this function returns true for the bytes drawn so far.
  std::function<bool(const std::string& drawn)> interrupt_when = {};
};

struct TerminalResult {
  int exit_code = -1;               ///< negative: ended by that signal
  std::string drawn;                ///< every byte that reached the terminal
  std::vector<std::string> lines;   ///< the final lines of the screen, without blanks at the ends
  std::vector<std::string> frames;  ///< the text of the current line before each carriage return
};

/// Runs the program under test with TERM=xterm and without NO_COLOR unless the environment says
/// otherwise. Throws std::runtime_error if the program does not end within `patience`.
TerminalResult run_on_terminal(const Words& arguments, const TerminalOptions& options = {});

}  // namespace ibmfair::test
