// A run of this program in a child process.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <poll.h>
#include <sys/types.h>

namespace ibmfair::commands {

/// How a process ended.
struct ChildEnd {
  int exit_code = 0;      ///< 128 + signal_number if a signal ended the process
  int signal_number = 0;  ///< signal that ended the process; 0: none
  double peak_megabytes = 0;
};

/// A child process of which standard output and standard error are collected; its standard input is
/// empty. The child ends when this process ends, even if this process is killed.
class ChildProcess {
 public:
  /// Starts the process. Throws std::runtime_error if the system cannot start a process.
  explicit ChildProcess(const std::vector<std::string>& arguments);
  /// Kills the process if it is still running.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Appends the two streams to the descriptors to wait for. A stream that has ended has descriptor
  /// -1, which poll() ignores.
  void append_waits(std::vector<pollfd>& waits) const;

  /// Reads the bytes that are available on the streams. Returns whether both streams have ended.
  bool read_streams();

  /// Waits for the end of the process, which follows shortly after the end of both streams.
  ChildEnd wait();

  void kill();

  pid_t id() const { return id_; }
  const std::string& out() const { return out_.text; }
  const std::string& err() const { return err_.text; }

 private:
  struct Stream {
    int fd = -1;
    std::string text;
    void read();
    void close();
  };

  pid_t id_ = -1;
  bool running_ = false;
  Stream out_, err_;
};

}  // namespace ibmfair::commands
