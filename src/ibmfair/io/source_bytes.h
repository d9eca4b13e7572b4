// The bytes of one input file, and error messages that point into them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace ibmfair {

/// A file that is read completely into memory, so that later changes to the file (an edit, a
/// truncation, the output replacing it) do not affect a run.
class SourceBytes {
 public:
  /// Reads the file `path`, or standard input for "-", and decompresses it if it is gzip data.
  /// Throws BadFile with the reason that the system gives, or if the gzip data is damaged.
  static std::shared_ptr<const SourceBytes> read(const std::string& path);

  /// Copies bytes that are in memory already; `name` is the name to use in messages.
  static std::shared_ptr<const SourceBytes> from_memory(std::string name, std::string_view bytes);

  /// `size` bytes that `fill` writes to the place it is given.
  static std::shared_ptr<const SourceBytes> from_memory(std::string name, std::size_t size,
                                                        const std::function<void(char*)>& fill);

  std::string_view view() const { return {bytes_.get(), size_}; }
  const char* begin() const { return bytes_.get(); }
  /// The end of the bytes. A line feed is stored there, so that a search for the end of a number or
  /// of a line need not check for the end of the file.
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

/// A place in a text file: lines end with LF, CRLF or CR; columns count bytes; both start with 1.
struct TextPlace {
  std::int64_t line = 1;
  std::int64_t column = 1;
};
TextPlace text_place(const SourceBytes& source, const char* where);

/// The word at `where`, shortened for a message.
std::string word_at(const SourceBytes& source, const char* where);

/// Throws BadFile "NAME:LINE:COL: message in 'text'" for the place `where` in a text file; `text`
/// is the word at that place.
[[noreturn]] void fail_in_text(const SourceBytes& source, const char* where,
                               std::string_view message);

/// Throws BadFile "NAME: ELEMENT ROW (byte B): message" for the place `where` in a binary file.
[[noreturn]] void fail_in_binary(const SourceBytes& source, std::string_view element,
                                 std::int64_t row, const char* where, std::string_view message);

/// Throws BadFile "NAME: message", for an error without a place in the file.
[[noreturn]] void fail_in_file(const SourceBytes& source, std::string_view message);

}  // namespace ibmfair
