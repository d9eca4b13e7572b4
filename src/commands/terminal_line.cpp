#include "commands/terminal_line.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <string>

#include <sys/ioctl.h>
#include <sys/uio.h>
#include <unistd.h>

namespace ibmfair::commands {

namespace {

constexpr std::size_t echo = 2;  // columns of the `^C` that a terminal writes behind the text

constexpr auto blanks = [] {
  std::array<char, 512> line{};
  line.fill(' ');
  return line;
}();

std::mutex drawing;
std::string shown_text;  // text of the last call; may have been cleared since
std::atomic<std::size_t> shown_columns{0};
std::atomic<bool> shows_no_more{false};
static_assert(std::atomic<std::size_t>::is_always_lock_free);

void put(std::string_view text) {
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text.data(), text.size());
}

void clear_columns(std::size_t count) {
  constexpr std::string_view back = "\r";
  const std::size_t columns = std::min(count, blanks.size());
  const std::array<iovec, 3> pieces{iovec{const_cast<char*>(back.data()), back.size()},
                                    iovec{const_cast<char*>(blanks.data()), columns},
                                    iovec{const_cast<char*>(back.data()), back.size()}};
  [[maybe_unused]] const ssize_t written = writev(STDERR_FILENO, pieces.data(), pieces.size());
}

}  // namespace

std::size_t terminal_columns(int descriptor) {
  winsize size{};
  return ioctl(descriptor, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

void show_terminal_line(std::string_view text) {
  const std::unique_lock lock(drawing);
  if (shows_no_more || (shown_columns == text.size() && shown_text == text)) {
    return;
  }
  shown_text = text;
  std::string line = "\r";
  line += text;
  const std::size_t before = shown_columns.exchange(text.size());
  if (before > text.size()) {
    line.append(before - text.size(), ' ');
    line += '\r';
    line += text;
  }
  put(line);
}

void clear_terminal_line() {
  if (const std::size_t columns = shown_columns.exchange(0); columns > 0) {
    clear_columns(columns + echo);
  }
}

void end_terminal_line() {
  shows_no_more = true;
  clear_terminal_line();
}

TerminalPause::TerminalPause() : lock_(drawing) {
  clear_terminal_line();
}

}  // namespace ibmfair::commands
