// Runs a separate process to handle a file that could crash this one.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

namespace ibmfair {

/// How a process ended.
struct ProcessEnd {
  int exit_code = -1;      ///< negative: the process did not exit by itself
  int signal_number = 0;   ///< the signal that ended the process, or 0
  bool timed_out = false;  ///< the process did not send everything in time
};

/// A child process. Its standard input is a socket for bytes in both directions; its standard
/// output and error go to /dev/null.
class ImportProcess {
 public:
  /// Starts `program`. All bytes must be received within `patience` from now. Throws
  /// std::system_error if the system cannot start it.
  ImportProcess(const std::string& program, std::vector<std::string> arguments,
                std::chrono::seconds patience);
  /// Ends the process if it still runs.
  ~ImportProcess();
  ImportProcess(const ImportProcess&) = delete;
  ImportProcess& operator=(const ImportProcess&) = delete;

  /// Sends bytes. If the process does not read them, this is not reported here: its reply will be
  /// missing.
  void send(std::string_view bytes);

  /// Receives `size` bytes; false if the process sent fewer bytes before it ended or time ran out.
  bool receive(void* data, std::size_t size);

  /// Ends the process, unless it has exited already, and returns how it ended. May be called once
  /// only.
  ProcessEnd end();

 private:
  using Clock = std::chrono::steady_clock;

  Clock::time_point deadline_;
  pid_t id_ = -1;
  int socket_ = -1;
  bool timed_out_ = false;
};

}  // namespace ibmfair
