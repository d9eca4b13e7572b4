#include "commands/batch/item_queue.h"

#include <algorithm>
#include <numeric>

namespace ibmfair::commands {

ItemQueue::ItemQueue(std::size_t items, std::chrono::milliseconds longest_pause)
    : now_(items), longest_pause_(longest_pause) {
  std::iota(now_.begin(), now_.end(), std::size_t{0});
}

std::optional<std::size_t> ItemQueue::next() {
  if (now_.empty() && !later_.empty() && Clock::now() >= due_) {
    now_.assign(later_.begin(), later_.end());
    later_.clear();
  }
  if (now_.empty()) {
    return std::nullopt;
  }
  const std::size_t index = now_.front();
  now_.pop_front();
  return index;
}

void ItemQueue::put_back(std::size_t index) {
  if (later_.empty()) {
    due_ = Clock::now() + std::min(pause_, longest_pause_);
    pause_ = std::min(2 * pause_, longest_pause_);
  }
  later_.push_back(index);
}

std::chrono::milliseconds ItemQueue::pause() const {
  if (!now_.empty()) {
    return std::chrono::milliseconds(0);
  }
  const auto rest = std::chrono::ceil<std::chrono::milliseconds>(due_ - Clock::now());
  return std::max(rest, std::chrono::milliseconds(0));
}

}  // namespace ibmfair::commands
