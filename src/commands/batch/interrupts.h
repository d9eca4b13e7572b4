// Signals that ask the batch to stop.
#pragma once

#include <csignal>
#include <utility>
#include <vector>

#include <poll.h>

namespace ibmfair::commands {

/// While this object exists, SIGINT, SIGTERM and SIGHUP do not end the process; they only end
/// wait(), so that the batch can stop in an orderly way. Signals that are ignored stay ignored.
/// Only one such object may exist at a time.
class Interrupts {
 public:
  Interrupts();
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

  /// Waits until one of the descriptors can be read or a signal arrives. Negative descriptors are
  /// ignored.
  void wait(std::vector<pollfd>& waits) const;

  /// The number of the signal that has arrived; 0 if none has.
  int signal_number() const;

 private:
  sigset_t mask_before_{};
  std::vector<std::pair<int, struct sigaction>> actions_before_;
};

}  // namespace ibmfair::commands
