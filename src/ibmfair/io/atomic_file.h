// An output file that appears complete or not at all.
#pragma once

#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>

#include "ibmfair/io/temporary_file.h"

namespace ibmfair {

/// Collects output in a temporary file in the target's directory; commit() flushes it to the disk
/// and moves it to the target. Without commit() the target stays as it was. A symbolic link is
/// followed, the file that it names is replaced or, with `overwrite` only, made. An existing file
/// keeps its permissions. Standard output ("-"), devices and pipes are written directly.
///
/// Every member throws CannotWrite, naming the target and the reason.
class AtomicFile {
 public:
  /// Refuses an existing file unless `overwrite`, one that is write-protected always.
  AtomicFile(const std::string& path, bool overwrite);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends to the output.
  void write(std::string_view bytes) {
    if (bytes.size() > capacity - used_) {
      write_through(bytes);
    } else if (!bytes.empty()) {
      std::memcpy(buffer_.get() + used_, bytes.data(), bytes.size());
      used_ += bytes.size();
    }
  }

  /// Appends the shortest text that reads back to the same double.
  void write_real(double value);

  /// Makes the output the target. Nothing may be written afterwards.
  void commit();

  /// Bytes written so far.
  std::int64_t bytes() const { return flushed_ + static_cast<std::int64_t>(used_); }

 private:
  static constexpr std::size_t capacity = std::size_t{1} << 18;

  void write_through(std::string_view bytes);
  void flush();
  [[noreturn]] void fail(int error) const;

  std::string name_;    // as messages name the target
  std::string target_;  // symbolic links resolved; empty where written directly
  TemporaryFile temporary_;
  bool overwrite_;
  int fd_ = -1;  // of what is written to
  std::unique_ptr<char[]> buffer_;
  std::size_t used_ = 0;
  std::int64_t flushed_ = 0;
};

/// Throws what writing to `path` would throw at once (it exists, its directory is missing or
/// protected), so that a long computation need not run into it at its end. Devices and pipes are
/// not opened for that.
void require_writable(const std::string& path, bool overwrite);

}  // namespace ibmfair
