#include "ibmfair/io/import_process.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace ibmfair {
namespace {

[[noreturn]] void fail_to_start(const std::string& program, int error) {
  throw std::system_error(error, std::generic_category(), program);
}

class ImportStreams {
 public:
  explicit ImportStreams(int socket) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_adddup2(&actions_, socket, STDIN_FILENO);
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
      posix_spawn_file_actions_addopen(&actions_, stream, "/dev/null", O_WRONLY, 0);
    }
  }
  ~ImportStreams() { posix_spawn_file_actions_destroy(&actions_); }
  ImportStreams(const ImportStreams&) = delete;
  ImportStreams& operator=(const ImportStreams&) = delete;
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

pid_t spawn_import(const std::string& program, std::vector<std::string>& arguments, int socket) {
  std::vector<char*> words{const_cast<char*>(program.c_str())};
  for (std::string& argument : arguments) {
    words.push_back(argument.data());
  }
  words.push_back(nullptr);
  pid_t id = -1;
  const int error = posix_spawn(&id, program.c_str(), ImportStreams(socket).get(), nullptr,
                                words.data(), environ);
  if (error != 0) fail_to_start(program, error);
  return id;
}

}  // namespace

ImportProcess::ImportProcess(const std::string& program, std::vector<std::string> arguments,
                             std::chrono::seconds patience)
    : deadline_(Clock::now() + patience) {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    fail_to_start(program, errno);
  }
  socket_ = ends[0];
  const struct timeval wait { patience.count(), 0 };
  setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &wait, sizeof wait);
  setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &wait, sizeof wait);
  try {
    id_ = spawn_import(program, arguments, ends[1]);
  } catch (...) {
    close(ends[0]);
    close(ends[1]);
    throw;
  }
  close(ends[1]);
}

ImportProcess::~ImportProcess() {
  if (id_ > 0) end();
  close(socket_);
}

void ImportProcess::send(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

bool ImportProcess::receive(void* data, std::size_t size) {
  auto* rest = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t count = recv(socket_, rest, size, 0);
    if (count < 0 && errno == EINTR) continue;
    // The deadline applies even if the process keeps sending a few bytes.
    timed_out_ = (count < 0 && errno == EAGAIN) || Clock::now() > deadline_;
    if (count <= 0 || timed_out_) return false;
    rest += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

ProcessEnd ImportProcess::end() {
  int status = 0;
  pid_t ended = waitpid(id_, &status, WNOHANG);
  if (ended == 0) {
    // A process that is exiting already keeps its exit code; one that only closed its socket would
    // run on.
    kill(id_, SIGKILL);
    do {
      ended = waitpid(id_, &status, 0);
    } while (ended < 0 && errno == EINTR);
  }
  id_ = -1;
  ProcessEnd result;
  result.timed_out = timed_out_;
  // If this program ignores SIGCHLD, the system does not report how the process ended.
  if (ended < 0) return result;
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result.signal_number = WTERMSIG(status);
  return result;
}

}  // namespace ibmfair
