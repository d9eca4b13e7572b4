#include "commands/console.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <new>
#include <string>

#include <sys/uio.h>
#include <unistd.h>

#include "commands/printable.h"
#include "commands/terminal_line.h"
#include "ibmfair/io/atomic_file.h"

namespace ibmfair::commands {

namespace {

std::string_view variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

bool wants_colour(bool on_terminal) {
  const std::string_view terminal = variable("TERM"), force = variable("CLICOLOR_FORCE");
  if (!variable("NO_COLOR").empty() || terminal == "dumb") {
    return false;
  }
  return (!force.empty() && force != "0") || (on_terminal && !terminal.empty());
}

struct Label {
  std::string_view text, colour;
};

Label label_of(MessageKind kind) {
  switch (kind) {
    case MessageKind::error:
      return {"error: ", "\x1b[1;31m"};
    case MessageKind::warning:
      return {"warning: ", "\x1b[1;33m"};
    case MessageKind::note:
    case MessageKind::detail:
      break;
  }
  return {};
}

}  // namespace

Console::Console() : terminal_(isatty(STDERR_FILENO) == 1), coloured_(wants_colour(terminal_)) {}

void Console::error(std::string_view text) const {
  say(MessageKind::error, text);
}

void Console::warning(std::string_view text) const {
  if (level_ != Level::quiet) {
    say(MessageKind::warning, text);
  }
}

void Console::detail(std::string_view text) const {
  if (level_ == Level::verbose) {
    say(MessageKind::detail, text);
  }
}

void Console::note(std::string_view text, std::string_view table) const {
  if (level_ != Level::quiet) {
    say(MessageKind::note, text, table);
  }
}

void Console::say(MessageKind kind, std::string_view text, std::string_view table) const {
  if (listener_ != nullptr) {
    listener_->message(kind, text);
    return;
  }
  std::string escaped;
  if (!is_printable(text)) {
    try {
      escaped = printable(text);
      text = escaped;
    } catch (const std::bad_alloc&) {
      text = "(a message with control characters, which there is no memory to escape)";
    }
  }
  const TerminalPause pause;
  const auto [label, colour] = label_of(kind);
  const bool in_colour = coloured_ && !colour.empty();
  const std::array<std::string_view, 7> parts{
      "ibmfair: ", in_colour ? colour : "", label, in_colour ? "\x1b[0m" : "", text, "\n", table};
  std::array<iovec, parts.size()> pieces{};
  std::transform(parts.begin(), parts.end(), pieces.begin(), [](std::string_view part) {
    return iovec{const_cast<char*>(part.data()), part.size()};
  });
  // Each message is written by one call, so that the lines of several programs on one terminal do
  // not mix, and without allocation, because memory may have run out. An error cannot be reported
  // anywhere.
  [[maybe_unused]] const ssize_t written = writev(STDERR_FILENO, pieces.data(), pieces.size());
}

void write_standard_output(std::string_view bytes) {
  AtomicFile out("-", true);
  out.write(bytes);
  out.commit();
}

}  // namespace ibmfair::commands
