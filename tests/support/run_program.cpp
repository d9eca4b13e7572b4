#include "support/run_program.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <stdexcept>
#include <string_view>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace ibmfair::test {

namespace {

class Descriptor {
 public:
  explicit Descriptor(int fd = -1) : fd_(fd) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept : fd_(other.fd_) { other.fd_ = -1; }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  Descriptor& operator=(Descriptor&&) = delete;

  int get() const { return fd_; }
  bool open() const { return fd_ >= 0; }
  void close() {
    if (open()) {
      ::close(fd_);
      fd_ = -1;
    }
  }

 private:
  int fd_;
};

struct Pipe {
  Descriptor reader;
  Descriptor writer;
};

Pipe make_pipe() {
  std::array<int, 2> ends{};
  // Close-on-exec: the program must see the end of its input when the test closes its own end of
  // the pipe.
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw std::runtime_error("cannot make a pipe");
  }
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

class SpawnActions {
 public:
  SpawnActions() { posix_spawn_file_actions_init(&actions_); }
  ~SpawnActions() { posix_spawn_file_actions_destroy(&actions_); }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;
  posix_spawn_file_actions_t* get() { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

// The test ignores SIGPIPE; the program must receive SIGPIPE as it would under a shell.
class SpawnAttributes {
 public:
  SpawnAttributes() {
    posix_spawnattr_init(&attributes_);
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGPIPE);
    posix_spawnattr_setsigdefault(&attributes_, &signals);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGDEF);
  }
  ~SpawnAttributes() { posix_spawnattr_destroy(&attributes_); }
  SpawnAttributes(const SpawnAttributes&) = delete;
  SpawnAttributes& operator=(const SpawnAttributes&) = delete;
  posix_spawnattr_t* get() { return &attributes_; }

 private:
  posix_spawnattr_t attributes_{};
};

std::vector<char*> pointers(std::vector<std::string>& strings) {
  std::vector<char*> result;
  result.reserve(strings.size() + 1);
  for (std::string& s : strings) {
    result.push_back(s.data());
  }
  result.push_back(nullptr);
  return result;
}

std::vector<std::string> environment_with(const std::vector<std::string>& extra) {
  std::vector<std::string> result = extra;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view name =
        std::string_view(*entry).substr(0, std::string_view(*entry).find('=') + 1);
    bool replaced = false;
    for (const std::string& given : extra) {
      replaced = replaced || given.starts_with(name);
    }
    if (!replaced) {
      result.emplace_back(*entry);
    }
  }
  return result;
}

pid_t spawn(const std::vector<std::string>& arguments, const RunOptions& options, int in, int out,
            int err) {
  SpawnActions actions;
  posix_spawn_file_actions_adddup2(actions.get(), in, STDIN_FILENO);
  if (options.output == StandardOutput::closed) {
    posix_spawn_file_actions_addclose(actions.get(), STDOUT_FILENO);
  } else if (options.output == StandardOutput::full) {
    posix_spawn_file_actions_addopen(actions.get(), STDOUT_FILENO, "/dev/full", O_WRONLY, 0);
  } else {
    posix_spawn_file_actions_adddup2(actions.get(), out, STDOUT_FILENO);
  }
  posix_spawn_file_actions_adddup2(actions.get(), err, STDERR_FILENO);
  if (!options.directory.empty()) {
    posix_spawn_file_actions_addchdir_np(actions.get(), options.directory.c_str());
  }

  for (const int descriptor : options.closed) {
    posix_spawn_file_actions_addclose(actions.get(), descriptor);
  }

  std::vector<std::string> words = options.limits;
  if (options.address_space > 0) {
    words.push_back("--as=" + std::to_string(options.address_space));
  }
  if (!words.empty()) {
    words.insert(words.begin(), "/usr/bin/prlimit");
  }
  words.insert(words.end(), options.launcher.begin(), options.launcher.end());
  words.push_back(program_path());
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<std::string> variables = environment_with(options.environment);
  SpawnAttributes attributes;
  pid_t child = -1;
  if (posix_spawn(&child, words.front().c_str(), actions.get(), attributes.get(),
                  pointers(words).data(), pointers(variables).data()) != 0) {
    throw std::runtime_error("cannot run " + words.front());
  }
  return child;
}

void feed(Descriptor& pipe, std::string_view& rest) {
  const ssize_t count = write(pipe.get(), rest.data(), rest.size());
  if (count > 0) {
    rest.remove_prefix(static_cast<std::size_t>(count));
  } else if (count < 0 && errno != EINTR && errno != EAGAIN) {
    pipe.close();
  }
}

void drain(Descriptor& pipe, std::string& collected) {
  std::array<char, 65536> buffer{};
  const ssize_t count = read(pipe.get(), buffer.data(), buffer.size());
  if (count > 0) {
    collected.append(buffer.data(), static_cast<std::size_t>(count));
  } else if (count == 0 || errno != EINTR) {
    pipe.close();
  }
}

// Serves all three pipes at once: otherwise a program that fills one pipe while the test waits on
// another pipe would never end. Returns whether all pipes were served within the limit.
bool exchange(pid_t child, Pipe& in, Pipe& out, Pipe& err, const RunOptions& options,
              RunResult& result) {
  using clock = std::chrono::steady_clock;
  const clock::time_point end = clock::now() + options.limit;
  std::string_view rest = options.input;
  fcntl(in.writer.get(), F_SETFL, O_NONBLOCK);
  bool fed = false;
  bool signalled = false;
  while (out.reader.open() || err.reader.open()) {
    if (rest.empty() && !fed) {
      fed = true;
      if (options.signal_number == 0 || options.signal_when) {
        in.writer.close();
      } else {
        kill(child, options.signal_number);
      }
    }
    std::array<pollfd, 3> waits{{{fed ? -1 : in.writer.get(), POLLOUT, 0},
                                 {out.reader.get(), POLLIN, 0},
                                 {err.reader.get(), POLLIN, 0}}};
    poll(waits.data(), waits.size(), options.signal_when && !signalled ? 2 : 1000);
    if (options.signal_when && !signalled && options.signal_when()) {
      signalled = true;
      kill(child, options.signal_number);
    }
    if (clock::now() > end) {
      return false;
    }
    if (waits[0].revents != 0) {
      feed(in.writer, rest);
    }
    if (waits[1].revents != 0) {
      drain(out.reader, result.out);
    }
    if (waits[2].revents != 0) {
      drain(err.reader, result.err);
    }
  }
  return true;
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

RunResult run_program(const std::vector<std::string>& arguments, const RunOptions& options) {
  signal(SIGPIPE, SIG_IGN);  // a program that does not read its input must not end the test
  Pipe in = make_pipe();
  Pipe out = make_pipe();
  Pipe err = make_pipe();
  if (options.output == StandardOutput::broken_pipe) {
    out.reader.close();
  }
  const pid_t child =
      spawn(arguments, options, in.reader.get(), out.writer.get(), err.writer.get());
  in.reader.close();
  out.writer.close();
  err.writer.close();
  if (options.output != StandardOutput::captured) {
    out.reader.close();
  }

  RunResult result;
  const bool ended = exchange(child, in, out, err, options, result);
  if (!ended) {
    kill(child, SIGKILL);
  }
  int status = 0;
  struct rusage usage {};
  while (wait4(child, &status, 0, &usage) < 0 && errno == EINTR) {
  }
  if (!ended) {
    throw std::runtime_error("the program did not end in time");
  }
  result.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  result.peak_megabytes = static_cast<double>(usage.ru_maxrss) / 1024;
  result.page_faults = usage.ru_minflt;
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  return result;
}

std::string program_path() {
  return IBMFAIR_PROGRAM;
}

bool runs_in_emulator() {
  return IBMFAIR_IN_EMULATOR != 0;
}

Words operator+(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

bool writes_pages() {
  static const bool pages =
      !contains(run_program({"view", "none", "none.html"}).err, "no report page");
  return pages;
}

}  // namespace ibmfair::test
