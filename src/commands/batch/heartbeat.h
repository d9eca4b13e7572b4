// Keeps the claims of this process alive, whatever else it does meanwhile.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <set>
#include <thread>

namespace ibmfair::commands {

class Claim;

/// A thread that renews the claims it knows, over and over.
class Heartbeat {
 public:
  explicit Heartbeat(std::chrono::milliseconds interval);
  ~Heartbeat();
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;

  void add(Claim& claim);
  /// It is not renewed any more once this returns.
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
