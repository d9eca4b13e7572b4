#include "ibmfair/io/byte_patcher.h"

#include <algorithm>
#include <charconv>

#include "ibmfair/base/parallel.h"
#include "ibmfair/io/numbers.h"

namespace ibmfair {
namespace {

// Limits on the pieces that wait to be written, which take memory and should fit into the cache.
constexpr std::size_t most_pieces = 8192;
constexpr std::size_t most_bytes = std::size_t{1} << 20;
constexpr std::size_t pieces_per_task = 512;

}  // namespace

void BytePatcher::copy_up_to(const char* p) {
  write_pieces();
  if (p > copied_) out_.write({copied_, static_cast<std::size_t>(p - copied_)});
  copied_ = p;
}

void BytePatcher::put_off(const char* first, const char* last, double value, bool single) {
  const auto size = static_cast<std::size_t>(first - copied_);
  if (size > most_bytes) {
    copy_up_to(first);
  } else if (pieces_.size() == most_pieces || piece_bytes_ + size > most_bytes) {
    write_pieces();
  }
  pieces_.push_back({{copied_, first}, value, single});
  piece_bytes_ += pieces_.back().copied.size();
  copied_ = last;
}

void BytePatcher::write_pieces() {
  const std::size_t tasks = (pieces_.size() + pieces_per_task - 1) / pieces_per_task;
  texts_.resize(std::max(texts_.size(), tasks));
  run_tasks(static_cast<std::int64_t>(tasks), tasks > 1, [&](std::int64_t task) {
    const std::size_t begin = static_cast<std::size_t>(task) * pieces_per_task;
    const std::size_t count = std::min(pieces_per_task, pieces_.size() - begin);
    join({pieces_.data() + begin, count}, texts_[task]);
  });
  for (std::size_t task = 0; task < tasks; ++task)
    out_.write(texts_[task]);
  pieces_.clear();
  piece_bytes_ = 0;
}

void BytePatcher::join(std::span<const Piece> pieces, std::string& text) {
  std::size_t room = 0;
  for (const Piece& piece : pieces)
    room += piece.copied.size() + number_text_capacity;
  text.resize(room);
  char* to = text.data();
  for (const auto& [copied, value, single] : pieces) {
    to = std::copy_n(copied.data(), copied.size(), to);
    char* const end = to + number_text_capacity;
    to =
        (single ? std::to_chars(to, end, static_cast<float>(value)) : std::to_chars(to, end, value))
            .ptr;
  }
  text.resize(static_cast<std::size_t>(to - text.data()));
}

}  // namespace ibmfair
