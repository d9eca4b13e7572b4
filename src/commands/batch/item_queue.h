// The order in which items are started.
#pragma once

#include <chrono>
#include <deque>
#include <optional>
#include <vector>

namespace ibmfair::commands {

/// A queue of item indices 0 .. items - 1. An item that cannot be started yet is put back; all
/// items that were put back come up again together after a pause. The pauses grow up to
/// `longest_pause`.
class ItemQueue {
 public:
  ItemQueue(std::size_t items, std::chrono::milliseconds longest_pause);

  /// The next item to start; nothing if there is none at the moment.
  std::optional<std::size_t> next();

  void put_back(std::size_t index);

  /// Number of items that are left, including the items that were put back.
  std::size_t size() const { return now_.size() + later_.size(); }
  bool empty() const { return size() == 0; }

  /// Time until the next item comes up; 0 if an item is ready.
  std::chrono::milliseconds pause() const;

 private:
  using Clock = std::chrono::steady_clock;

  std::deque<std::size_t> now_;
  std::vector<std::size_t> later_;
  Clock::time_point due_{};  // when the items in later_ come up again
  std::chrono::milliseconds pause_{20}, longest_pause_;
};

}  // namespace ibmfair::commands
