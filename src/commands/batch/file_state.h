// By what a file is known to be the same as before.
#pragma once

#include <cstdint>
#include <ctime>
#include <optional>
#include <string>
#include <string_view>

namespace ibmfair::commands {

/// Its size, and when its content (mtime) and anything about it (ctime) last changed, in
/// nanoseconds.
struct FileStamp {
  std::int64_t size = 0;
  std::int64_t mtime = 0;
  std::int64_t ctime = 0;

  bool operator==(const FileStamp&) const = default;
};

std::int64_t nanoseconds(const timespec& time);

/// Nothing where there is no regular file.
std::optional<FileStamp> stamp_of(const std::string& path);

/// FNV-1a of 64 bits, in hexadecimal digits.
std::string hash_of_text(std::string_view text);

/// The hash of a file's bytes, as `hash_of_text`; nothing where the file cannot be read.
std::optional<std::string> hash_of_file(const std::string& path);

}  // namespace ibmfair::commands
