// In which order items come up.
#pragma once

#include <chrono>
#include <deque>
#include <optional>
#include <vector>

namespace ibmfair::commands {

/// The places of a list in their order. Those that cannot be served yet are put back and come up
/// again, all together, after pauses that grow.
class ItemQueue {
 public:
  ItemQueue(std::size_t items, std::chrono::milliseconds longest_pause);

  /// The one that comes up now; nothing where there is none at the moment.
  std::optional<std::size_t> next();

  void put_back(std::size_t index);

  /// How many are left, for now and for later.
  std::size_t size() const { return now_.size() + later_.size(); }
  bool empty() const { return size() == 0; }

  /// How long until one comes up.
  std::chrono::milliseconds pause() const;

 private:
  using Clock = std::chrono::steady_clock;

  std::deque<std::size_t> now_;
  std::vector<std::size_t> later_;
  Clock::time_point due_{};  // of those for later
  std::chrono::milliseconds pause_{20}, longest_pause_;
};

}  // namespace ibmfair::commands
