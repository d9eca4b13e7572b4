// The interface through which the writers of all formats output bytes.
#pragma once

#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>

namespace ibmfair {

/// Collects bytes in a buffer and passes them on when the buffer is full.
class ByteSink {
 public:
  ByteSink() : buffer_(std::make_unique_for_overwrite<char[]>(capacity)) {}
  virtual ~ByteSink() = default;
  ByteSink(const ByteSink&) = delete;
  ByteSink& operator=(const ByteSink&) = delete;

  /// Appends to the output.
  void write(std::string_view bytes) {
    if (bytes.size() > capacity - used_) {
      flush();
      pass_on(bytes);
    } else if (!bytes.empty()) {
      std::memcpy(buffer_.get() + used_, bytes.data(), bytes.size());
      used_ += bytes.size();
    }
  }

  /// Appends the shortest text that reads back to the same double.
  void write_real(double value);

  /// Bytes written so far.
  std::int64_t bytes() const { return passed_on_ + static_cast<std::int64_t>(used_); }

 protected:
  /// Passes on the contents of the buffer.
  void flush();

 private:
  static constexpr std::size_t capacity = std::size_t{1} << 18;

  /// Outputs all of the bytes, or throws.
  virtual void take(std::string_view bytes) = 0;
  void pass_on(std::string_view bytes);

  std::unique_ptr<char[]> buffer_;
  std::size_t used_ = 0;
  std::int64_t passed_on_ = 0;
};

/// Keeps the bytes in memory.
class MemorySink final : public ByteSink {
 public:
  /// All that was written.
  const std::string& text() {
    flush();
    return text_;
  }

 private:
  void take(std::string_view bytes) override { text_ += bytes; }

  std::string text_;
};

}  // namespace ibmfair
