#include "commands/batch/interrupts.h"

#include <initializer_list>

namespace ibmfair::commands {

namespace {

volatile std::sig_atomic_t arrived = 0;

extern "C" void note_signal(int signal_number) {
  arrived = signal_number;
}

}  // namespace

Interrupts::Interrupts() {
  arrived = 0;
  sigset_t blocked;
  sigemptyset(&blocked);
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    sigaction(signal_number, nullptr, &before);
    if (before.sa_handler == SIG_IGN) {
      continue;
    }
    sigaddset(&blocked, signal_number);
    actions_before_.emplace_back(signal_number, before);
  }
  // The signals are blocked except during the wait. Otherwise a signal that arrives just before the
  // wait would not end it.
  sigprocmask(SIG_BLOCK, &blocked, &mask_before_);
  for (const auto& [signal_number, before] : actions_before_) {
    struct sigaction action {};
    action.sa_handler = note_signal;
    sigaction(signal_number, &action, nullptr);
  }
}

Interrupts::~Interrupts() {
  for (const auto& [signal_number, before] : actions_before_) {
    sigaction(signal_number, &before, nullptr);
  }
  sigprocmask(SIG_SETMASK, &mask_before_, nullptr);
}

void Interrupts::wait(std::vector<pollfd>& waits) const {
  ppoll(waits.data(), waits.size(), nullptr, &mask_before_);
}

int Interrupts::signal_number() const {
  const timespec no_time{};
  ppoll(nullptr, 0, &no_time, &mask_before_);
  return arrived;
}

}  // namespace ibmfair::commands
