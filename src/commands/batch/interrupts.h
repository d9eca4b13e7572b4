// Signals that ask the batch to stop.
#pragma once

#include <chrono>
#include <csignal>
#include <optional>
#include <utility>
#include <vector>

#include <poll.h>

namespace ibmfair::commands {

/// While it exists, SIGINT, SIGTERM and SIGHUP do not end the process but only its waiting, so that
/// it can put things in order. One of a kind at a time. Those that are ignored stay so.
class Interrupts {
 public:
  Interrupts();
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

  /// Waits until one of the descriptors can be read, a signal arrives or, where there is one, the
  /// time is over; descriptors below 0 do not count.
  void wait(std::vector<pollfd>& waits,
            std::optional<std::chrono::milliseconds> time = std::nullopt) const;

  /// The signal that has arrived; 0: none.
  int signal_number() const;

 private:
  sigset_t mask_before_{};
  std::vector<std::pair<int, struct sigaction>> actions_before_;
};

}  // namespace ibmfair::commands
