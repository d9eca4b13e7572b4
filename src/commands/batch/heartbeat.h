// Renews the claims of this process in a thread of its own, while other threads are busy.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <set>
#include <thread>

namespace ibmfair::commands {

class Claim;

/// A thread that renews all claims that were added to it, once per interval.
class Heartbeat {
 public:
  explicit Heartbeat(std::chrono::milliseconds interval);
  ~Heartbeat();
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;

  void add(Claim& claim);
  /// Once this function has returned, the claim is no longer renewed.
  void remove(Claim& claim);

 private:
  void beat();

  std::chrono::milliseconds interval_;
  std::mutex mutex_;
  std::condition_variable ended_;
  bool end_ = false;
  std::set<Claim*> claims_;
  std::thread thread_;
};

}  // namespace ibmfair::commands
