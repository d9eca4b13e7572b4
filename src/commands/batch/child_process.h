// A run of this very program in a process of its own.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <poll.h>
#include <sys/types.h>

namespace ibmfair::commands {

/// How a process ended.
struct ChildEnd {
  int exit_code = 0;      ///< 128 + signal_number where that is not 0
  int signal_number = 0;  ///< that ended it
  double peak_megabytes = 0;
};

/// Both streams are collected; standard input is empty. The process ends with this one, even if
/// this one is killed.
class ChildProcess {
 public:
  /// Starts it. Throws std::runtime_error where the system refuses to.
  explicit ChildProcess(const std::vector<std::string>& arguments);
  /// Kills it if it still runs.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// What to wait for: the two streams; those that have ended are left out by poll.
  void append_waits(std::vector<pollfd>& waits) const;

  /// Takes what the streams hold now. Returns whether both have ended.
  bool read_streams();

  /// Waits for the end, which is near once both streams have ended.
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
