#include "commands/console.h"

#include <cstdio>
#include <cstdlib>
#include <string>

#include <unistd.h>

#include "commands/printable.h"
#include "ibmfair/io/atomic_file.h"

namespace ibmfair::commands {

namespace {

bool wants_colour() {
  const char* no_color = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  return (no_color == nullptr || *no_color == '\0') && terminal != nullptr &&
         std::string_view(terminal) != "dumb";
}

}  // namespace

Console::Console()
    : terminal_(isatty(STDERR_FILENO) == 1), coloured_(terminal_ && wants_colour()) {}

void Console::error(std::string_view text) const {
  say("error: ", "\x1b[1;31m", text);
}

void Console::warning(std::string_view text) const {
  if (level_ != Level::quiet) {
    say("warning: ", "\x1b[1;33m", text);
  }
}

void Console::detail(std::string_view text) const {
  if (level_ == Level::verbose) {
    say("", "", text);
  }
}

void Console::note(std::string_view text, std::string_view table) const {
  if (level_ != Level::quiet) {
    say("", "", text, table);
  }
}

void Console::say(std::string_view label, std::string_view colour, std::string_view text,
                  std::string_view table) const {
  std::string line = "ibmfair: ";
  if (coloured_ && !colour.empty()) {
    line.append(colour).append(label).append("\x1b[0m");
  } else {
    line.append(label);
  }
  line.append(printable(text)).append("\n").append(table);
  // One call a line, so that lines of several programs on one terminal do not mix. There is nobody
  // left to tell where it fails.
  std::fwrite(line.data(), 1, line.size(), stderr);
}

void write_standard_output(std::string_view bytes) {
  AtomicFile out("-", true);
  out.write(bytes);
  out.commit();
}

}  // namespace ibmfair::commands
