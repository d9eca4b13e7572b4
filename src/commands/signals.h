// Signal handlers: how the program ends on request or after a crash.
#pragma once

namespace ibmfair::commands {

/// Ignores SIGPIPE and SIGXFSZ, so that a write to a closed pipe or beyond the file size limit is
/// an error and does not end the process. A request to end (SIGINT, SIGTERM, SIGHUP, SIGQUIT,
/// SIGXCPU) removes the temporary files and ends the process with exit code 128 + signal. A crash
/// removes the temporary files and prints a message. Signals that are already ignored, as under
/// nohup, stay ignored.
void handle_signals();

/// While this object exists, the first request to end is only recorded, so that the computation can
/// stop between two steps and keep its result; the second request ends the process. Only one such
/// object may exist at a time.
class PostponedEnd {
 public:
  PostponedEnd();
  ~PostponedEnd();
  PostponedEnd(const PostponedEnd&) = delete;
  PostponedEnd& operator=(const PostponedEnd&) = delete;

  /// The signal that was recorded during the life of this or an earlier object; 0: none.
  static int signal_number();
};

}  // namespace ibmfair::commands
