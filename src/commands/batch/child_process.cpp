#include "commands/batch/child_process.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "commands/process.h"

namespace ibmfair::commands {

namespace {

/// Bytes of a stream beyond this number are read and discarded.
constexpr std::size_t most_text = std::size_t{1} << 26;

[[noreturn]] void fail(int error) {
  throw std::runtime_error(fmt::format("cannot start a process: {}", std::strerror(error)));
}

class SpawnActions {
 public:
  SpawnActions(int out, int err) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions_, out, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, err, STDERR_FILENO);
  }
  ~SpawnActions() { posix_spawn_file_actions_destroy(&actions_); }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

/// Attributes that unblock all signals in the child. The batch blocks signals except while it
/// waits, and the child would inherit the blocked signals.
class SpawnAttributes {
 public:
  SpawnAttributes() {
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK);
  }
  ~SpawnAttributes() { posix_spawnattr_destroy(&attributes_); }
  SpawnAttributes(const SpawnAttributes&) = delete;
  SpawnAttributes& operator=(const SpawnAttributes&) = delete;
  const posix_spawnattr_t* get() const { return &attributes_; }

 private:
  posix_spawnattr_t attributes_{};
};

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> result;
  result.reserve(words.size() + 1);
  for (std::string& word : words) {
    result.push_back(word.data());
  }
  result.push_back(nullptr);
  return result;
}

std::vector<std::string> environment_of_child() {
  std::vector<std::string> variables{fmt::format("{}={}", parent_variable, getpid())};
  for (char** entry = environ; *entry != nullptr; ++entry) {
    if (std::strncmp(*entry, parent_variable, std::strlen(parent_variable)) != 0) {
      variables.emplace_back(*entry);
    }
  }
  return variables;
}

std::array<int, 2> make_pipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    fail(errno);
  }
  return ends;
}

pid_t spawn(const std::vector<std::string>& arguments, int out, int err) {
  std::vector<std::string> words{"ibmfair"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<std::string> variables = environment_of_child();
  pid_t id = -1;
  const int error =
      posix_spawn(&id, "/proc/self/exe", SpawnActions(out, err).get(), SpawnAttributes().get(),
                  pointers(words).data(), pointers(variables).data());
  if (error != 0) {
    fail(error);
  }
  return id;
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& arguments) {
  const std::array<int, 2> out = make_pipe();
  out_.fd = out[0];
  const std::array<int, 2> err = make_pipe();
  err_.fd = err[0];
  for (const int fd : {out_.fd, err_.fd}) {
    fcntl(fd, F_SETFL, O_NONBLOCK);
  }
  try {
    id_ = spawn(arguments, out[1], err[1]);
    running_ = true;
  } catch (...) {
    for (const int fd : {out[0], out[1], err[0], err[1]}) {
      ::close(fd);
    }
    throw;
  }
  ::close(out[1]);
  ::close(err[1]);
}

ChildProcess::~ChildProcess() {
  if (running_) {
    kill();
    wait();
  }
  out_.close();
  err_.close();
}

void ChildProcess::Stream::close() {
  if (fd >= 0) {
    ::close(fd);
    fd = -1;
  }
}

void ChildProcess::Stream::read() {
  std::array<char, 65536> buffer{};
  while (fd >= 0) {
    const ssize_t count = ::read(fd, buffer.data(), buffer.size());
    if (count > 0 && text.size() < most_text) {
      text.append(buffer.data(), static_cast<std::size_t>(count));
    } else if (count < 0 && errno == EAGAIN) {
      return;
    } else if (count == 0 || (count < 0 && errno != EINTR)) {
      close();
    }
  }
}

void ChildProcess::append_waits(std::vector<pollfd>& waits) const {
  waits.push_back({out_.fd, POLLIN, 0});
  waits.push_back({err_.fd, POLLIN, 0});
}

bool ChildProcess::read_streams() {
  out_.read();
  err_.read();
  return out_.fd < 0 && err_.fd < 0;
}

ChildEnd ChildProcess::wait() {
  int status = 0;
  struct rusage usage {};
  while (wait4(id_, &status, 0, &usage) < 0 && errno == EINTR) {
  }
  running_ = false;
  ChildEnd end;
  end.signal_number = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  end.exit_code = end.signal_number != 0 ? 128 + end.signal_number : WEXITSTATUS(status);
  end.peak_megabytes = static_cast<double>(usage.ru_maxrss) / 1024;
  return end;
}

void ChildProcess::kill() {
  ::kill(id_, SIGKILL);
}

}  // namespace ibmfair::commands
