// Time stamps and hashes, by which an unchanged file is recognised.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ibmfair::commands {

/// The size of a file in bytes, and the times, in nanoseconds, of the last change of its content
/// (mtime) and of its content or attributes (ctime).
struct FileStamp {
  std::int64_t size = 0;
  std::int64_t mtime = 0;
  std::int64_t ctime = 0;

  bool operator==(const FileStamp&) const = default;
};

/// The stamp of the file at `path`; nothing if there is no regular file.
std::optional<FileStamp> stamp_of(const std::string& path);

/// The 64-bit FNV-1a hash of the text, in hexadecimal digits.
std::string hash_of_text(std::string_view text);

/// The hash of a file's bytes, as by `hash_of_text`; nothing if the file cannot be read.
std::optional<std::string> hash_of_file(const std::string& path);

}  // namespace ibmfair::commands
