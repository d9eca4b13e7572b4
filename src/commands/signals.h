// Signals: how the program ends when somebody or something wants it to.
#pragma once

namespace ibmfair::commands {

/// Makes a write to a closed pipe or beyond the limit of a file's size an error instead of the end
/// of the process. A request to end (SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU) removes temporary
/// files and ends it with exit code 128 + signal; a crash removes them, too, and says so. Signals
/// that are ignored, as under nohup, stay so.
void handle_signals();

/// While it exists, the first request to end is only noted, for work that can stop at a good place
/// and keep what it has; the second one ends the process. One of a kind at a time.
class PostponedEnd {
 public:
  PostponedEnd();
  ~PostponedEnd();
  PostponedEnd(const PostponedEnd&) = delete;
  PostponedEnd& operator=(const PostponedEnd&) = delete;

  /// The signal that was noted, by this or an earlier one of these; 0: none.
  static int signal_number();
};

}  // namespace ibmfair::commands
