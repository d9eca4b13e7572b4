// Reads an OBJ text statement by statement, without copying text and without counting lines.
#pragma once

#include <cstdint>
#include <cstring>
#include <string_view>

#include "ibmfair/io/characters.h"
#include "ibmfair/io/numbers.h"
#include "ibmfair/io/source_bytes.h"

namespace ibmfair::obj {

/// A face corner as written: each number is 1-based, or negative and counted from the end; 0 if
/// left out.
struct RawCorner {
  std::int64_t vertex = 0;
  std::int64_t texture = 0;
  std::int64_t normal = 0;
};

/// A statement is a keyword and its arguments up to the end of the line. A backslash before the end
/// of the line continues the statement on the next line, and `#` starts a comment. Lines end with
/// LF, CRLF or CR.
class ObjScanner {
 public:
  /// Starts before the first statement, after a UTF-8 byte-order mark if there is one.
  explicit ObjScanner(const SourceBytes& source);

  /// Starts before the statement that begins at `start`.
  ObjScanner(const SourceBytes& source, const char* start)
      : source_(source), p_(start), end_(source.end()) {}

  /// Advances to the next statement; false at the end of the text.
  bool next_statement();

  std::string_view keyword() const { return keyword_; }

  /// The start of the next argument, or the end of the arguments if there is none.
  const char* position() {
    skip_blanks();
    return p_;
  }

  /// The end of the last argument that was read.
  const char* position_after() const { return p_; }

  bool at_statement_end() {
    skip_blanks();
    return is(*p_, statement_end);
  }

  /// Reads a finite number; throws BadFile.
  double real() {
    skip_blanks();
    double value = 0.0;
    const char* after = parse_real(p_, end_, value);
    if (after == nullptr || !is(*after, delimiter)) fail_at_real();
    p_ = after;
    return value;
  }

  /// Reads a number, which may be NaN or infinite; the result is 0 if it is not finite. Throws
  /// BadFile for anything that is not a number.
  double any_real();

  /// Skips a number, with the same checks as any_real().
  void skip_number() { any_real(); }

  /// Skips an argument of any form.
  void skip_argument() {
    skip_blanks();
    skip_to(delimiter);
  }

  /// Reads `v`, `v/t`, `v//n` or `v/t/n`; throws BadFile for any other text.
  RawCorner corner() {
    skip_blanks();
    RawCorner corner;
    const char* start = p_;
    if (!index(corner.vertex)) fail(start, "not a vertex number");
    if (*p_ == '/') corner_references(start, corner);
    if (!is(*p_, delimiter)) fail(start, "not a vertex number");
    return corner;
  }

  /// The next argument as text; empty at the end of the statement.
  std::string_view word();

  /// The rest of the statement, without surrounding blanks.
  std::string_view rest();

  /// Skips to the end of the line, several times as fast as next_statement() would. Allowed only if
  /// has_plain_lines().
  void skip_plain_line() {
    p_ = static_cast<const char*>(std::memchr(p_, '\n', static_cast<std::size_t>(end_ - p_) + 1));
  }

  /// Whether no line ends with CR and the text has no backslash, so that no statement continues
  /// over several lines.
  static bool has_plain_lines(const SourceBytes& source) {
    return source.view().find('\r') == std::string_view::npos &&
           source.view().find('\\') == std::string_view::npos;
  }

  /// The start of the statement, and the start of the line after it.
  const char* statement_start() const { return keyword_.data(); }
  const char* after_statement();

  [[noreturn]] void fail(const char* where, std::string_view message) const {
    fail_in_text(source_, where, message);
  }

 private:
  static constexpr std::uint8_t blank = characters::blank;
  static constexpr std::uint8_t line_end = characters::line_end;
  static constexpr std::uint8_t continuation = characters::backslash;  // if a line end follows
  static constexpr std::uint8_t statement_end = line_end | characters::hash;
  static constexpr std::uint8_t delimiter = blank | statement_end | continuation;

  static bool is(char c, std::uint8_t kind) { return characters::is(c, kind); }
  void skip_to(std::uint8_t kind) { p_ = characters::find(p_, kind); }
  void skip_blanks() {
    p_ = characters::find_not(p_, blank);
    if (*p_ == '\\') skip_continuations();
  }
  bool index(std::int64_t& value) {
    const char* after = parse_integer(p_, end_, value);
    if (after != nullptr) p_ = after;
    return after != nullptr;
  }
  void corner_references(const char* start, RawCorner& corner);
  /// Whether the backslash at hand continues the line. One at the end of the file does not.
  bool continues_line() const { return p_ + 1 != end_ && is(p_[1], line_end); }
  void skip_continuations();
  void skip_line();
  [[noreturn]] void fail_at_real() const;

  const SourceBytes& source_;
  const char* p_;
  const char* end_;
  std::string_view keyword_;
};

}  // namespace ibmfair::obj
