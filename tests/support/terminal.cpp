#include "support/terminal.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

namespace ibmfair::test {

namespace {

constexpr char ctrl_c = 3;

/// Called in the child process, which becomes the program.
[[noreturn]] void become(const Words& arguments, const TerminalOptions& options) {
  setenv("TERM", "xterm", 1);
  unsetenv("NO_COLOR");
  unsetenv("CLICOLOR_FORCE");
  unsetenv("COLUMNS");
  for (const std::string& variable : options.environment) {
    const std::size_t equals = variable.find('=');
    setenv(variable.substr(0, equals).c_str(), variable.substr(equals + 1).c_str(), 1);
  }
  if (!options.directory.empty() && chdir(options.directory.c_str()) != 0) {
    _exit(126);
  }
  Words words{program_path()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) {
    pointers.push_back(word.data());
  }
  pointers.push_back(nullptr);
  execv(pointers.front(), pointers.data());
  _exit(127);
}

/// Reads the bytes that the program draws until the program ends; false if this takes too long.
bool watch(int terminal, const TerminalOptions& options, std::string& drawn) {
  const auto end = std::chrono::steady_clock::now() + patience;
  bool interrupted = false;
  while (std::chrono::steady_clock::now() < end) {
    pollfd wait{terminal, POLLIN, 0};
    poll(&wait, 1, 100);
    if (wait.revents == 0) {
      continue;
    }
    std::array<char, 4096> buffer{};
    const ssize_t count = read(terminal, buffer.data(), buffer.size());
    if (count <= 0) {
      return true;  // EIO: no process has the other end open any more
    }
    drawn.append(buffer.data(), static_cast<std::size_t>(count));
    if (!interrupted && options.interrupt_when && options.interrupt_when(drawn)) {
      interrupted = write(terminal, &ctrl_c, 1) == 1;
    }
  }
  return false;
}

std::string trimmed(const std::string& line) {
  return line.substr(0, line.find_last_not_of(' ') + 1);
}

/// The lines that a screen shows: a carriage return goes back to the start of the line, and the
/// next characters overwrite the line.
void show(const std::string& drawn, TerminalResult& result) {
  std::string line;
  std::size_t column = 0;
  for (const char c : drawn) {
    if (c == '\r') {
      result.frames.push_back(trimmed(line));
      column = 0;
    } else if (c == '\n') {
      result.lines.push_back(trimmed(line));
      line.clear();
      column = 0;
    } else {
      line.resize(std::max(line.size(), column + 1), ' ');
      line[column++] = c;
    }
  }
  result.lines.push_back(trimmed(line));
}

}  // namespace

TerminalResult run_on_terminal(const Words& arguments, const TerminalOptions& options) {
  winsize size{};
  size.ws_row = 50;
  size.ws_col = static_cast<unsigned short>(options.columns);
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, &size);
  if (child < 0) {
    throw std::runtime_error("no terminal to be had");
  }
  if (child == 0) {
    become(arguments, options);
  }
  TerminalResult result;
  const bool ended = watch(terminal, options, result.drawn);
  if (!ended) {
    kill(child, SIGKILL);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  close(terminal);
  if (!ended) {
    throw std::runtime_error("the program did not end in time");
  }
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  show(result.drawn, result);
  return result;
}

}  // namespace ibmfair::test
