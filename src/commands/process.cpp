#include "commands/process.h"

#include <csignal>
#include <cstdlib>
#include <string>

#include <fcntl.h>
#include <sys/prctl.h>
#include <unistd.h>

#include "commands/signals.h"
#include "ibmfair/base/process_memory.h"
#include "ibmfair/base/threads.h"

namespace ibmfair::commands {

namespace {

void keep_open(int descriptor, int unusable_mode) {
  if (fcntl(descriptor, F_GETFD) == -1) {
    // open() returns the lowest free descriptor, which is this one, because the lower standard
    // descriptors have been opened before.
    [[maybe_unused]] const int taken = open("/dev/null", unusable_mode);
  }
}

void end_with_parent() {
  const char* parent = std::getenv(parent_variable);
  if (parent != nullptr) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (std::to_string(getppid()) != parent) {  // the parent had ended before the call of prctl()
      _exit(128 + SIGKILL);
    }
  }
}

}  // namespace

void prepare_process() {
  end_with_parent();
  // Each placeholder has the opposite mode of its stream, so that using the stream still fails.
  keep_open(STDIN_FILENO, O_WRONLY);
  keep_open(STDOUT_FILENO, O_RDONLY);
  keep_open(STDERR_FILENO, O_RDONLY);
  handle_signals();
  keep_freed_memory();
  use_large_pages();
}

}  // namespace ibmfair::commands
