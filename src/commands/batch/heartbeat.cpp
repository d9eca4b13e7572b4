#include "commands/batch/heartbeat.h"

#include <csignal>

#include "commands/batch/claim.h"
#include "ibmfair/base/errors.h"

namespace ibmfair::commands {

Heartbeat::Heartbeat(std::chrono::milliseconds interval) : interval_(interval) {
  // The new thread inherits the signal mask. All signals are blocked in it, so that they reach the
  // thread that waits for signals.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, &before);
  thread_ = std::thread([this] { beat(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

Heartbeat::~Heartbeat() {
  {
    const std::lock_guard lock(mutex_);
    end_ = true;
  }
  ended_.notify_all();
  thread_.join();
}

void Heartbeat::add(Claim& claim) {
  const std::lock_guard lock(mutex_);
  claims_.insert(&claim);
}

void Heartbeat::remove(Claim& claim) {
  const std::lock_guard lock(mutex_);
  claims_.erase(&claim);
}

void Heartbeat::beat() {
  std::unique_lock lock(mutex_);
  while (!ended_.wait_for(lock, interval_, [this] { return end_; })) {
    for (Claim* claim : claims_) {
      claim->renew();
    }
  }
}

}  // namespace ibmfair::commands
