// The bytes of one input file, and error messages that point into them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace ibmfair {

/// A file read completely into memory: whatever happens to it afterwards (an edit, a truncation,
/// being the output's own target) does not reach a run that has begun.
class SourceBytes {
 public:
  /// Reads `path`, or standard input for "-". Throws BadFile with the system's reason.
  static std::shared_ptr<const SourceBytes> read(const std::string& path);

  /// Bytes that are in memory already, with the name that messages shall give them.
  static std::shared_ptr<const SourceBytes> from_memory(std::string name, std::string_view bytes);

  std::string_view view() const { return {bytes_.get(), size_}; }
  const char* begin() const { return bytes_.get(); }
  /// One behind the last byte. A line feed stands there, so that a search for the end of a number
  /// or line need not look out for the end of the file.
  const char* end() const { return bytes_.get() + size_; }
  std::size_t size() const { return size_; }

  /// The path as given, or "standard input".
  const std::string& name() const { return name_; }
  /// The path as given; empty for standard input and for bytes from memory.
  const std::string& path() const { return path_; }

 private:
  SourceBytes() = default;

  std::string name_;
  std::string path_;
  std::unique_ptr<char[]> bytes_;
  std::size_t size_ = 0;
};

/// Throws BadFile "NAME:LINE:COL: message in 'text'" for the place `where` in a text file; the text
/// is the word found there. Lines end with LF, CRLF or CR, columns count bytes from 1.
[[noreturn]] void fail_in_text(const SourceBytes& source, const char* where,
                               std::string_view message);

/// Throws BadFile "NAME: ELEMENT ROW (byte B): message" for the place `where` in a binary file.
[[noreturn]] void fail_in_binary(const SourceBytes& source, std::string_view element,
                                 std::int64_t row, const char* where, std::string_view message);

/// Throws BadFile "NAME: message" where no place can be named.
[[noreturn]] void fail_in_file(const SourceBytes& source, std::string_view message);

}  // namespace ibmfair
