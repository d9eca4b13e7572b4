#include "commands/process.h"

#include <csignal>
#include <cstdlib>
#include <initializer_list>
#include <string>

#include <fcntl.h>
#include <sys/prctl.h>
#include <unistd.h>

namespace ibmfair::commands {

namespace {

// Outputs are files without a name until they are complete, so there is nothing to clean up.
extern "C" void end_at_once(int signal_number) {
  _exit(128 + signal_number);
}

void keep_open(int descriptor, int unusable_mode) {
  if (fcntl(descriptor, F_GETFD) == -1) {
    // The lowest free number is taken, and lower ones have been seen to before.
    [[maybe_unused]] const int taken = open("/dev/null", unusable_mode);
  }
}

void end_with_parent() {
  const char* parent = std::getenv(parent_variable);
  if (parent != nullptr) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (std::to_string(getppid()) != parent) {  // it was gone before the kernel was asked
      _exit(128 + SIGKILL);
    }
  }
}

}  // namespace

void prepare_process() {
  end_with_parent();
  // The mode is the one that the stream is not used with, so that using it still fails.
  keep_open(STDIN_FILENO, O_WRONLY);
  keep_open(STDOUT_FILENO, O_RDONLY);
  keep_open(STDERR_FILENO, O_RDONLY);

  struct sigaction action {};
  action.sa_handler = SIG_IGN;
  sigaction(SIGPIPE, &action, nullptr);
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction inherited {};
    sigaction(signal_number, nullptr, &inherited);
    if (inherited.sa_handler != SIG_IGN) {  // nohup and background jobs want them ignored
      action.sa_handler = end_at_once;
      sigaction(signal_number, &action, nullptr);
    }
  }
}

}  // namespace ibmfair::commands
