// A process that does something with a file which this one must survive.
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
  int exit_code = -1;      ///< negative: it did not come to an end of its own
  int signal_number = 0;   ///< that ended it
  bool timed_out = false;  ///< it had not said everything after too long
};

/// Its standard input is a socket for bytes both ways, its other streams lead nowhere.
class ImportProcess {
 public:
  /// Starts `program`. Throws std::system_error where the system refuses to. Receiving bytes must
  /// be done after `patience`.
  ImportProcess(const std::string& program, std::vector<std::string> arguments,
                std::chrono::seconds patience);
  /// Ends it if it still runs.
  ~ImportProcess();
  ImportProcess(const ImportProcess&) = delete;
  ImportProcess& operator=(const ImportProcess&) = delete;

  /// Sends bytes. That the process does not take them shows when its reply is missing.
  void send(std::string_view bytes);

  /// Receives that many bytes; false where it sent fewer and then ended or was silent.
  bool receive(void* data, std::size_t size);

  /// Ends it, unless it has come to its end already, and tells how it ended; to be called once.
  ProcessEnd end();

 private:
  using Clock = std::chrono::steady_clock;

  Clock::time_point deadline_;
  pid_t id_ = -1;
  int socket_ = -1;
  bool timed_out_ = false;
};

}  // namespace ibmfair
