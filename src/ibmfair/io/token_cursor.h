// Reads a text of numbers separated by blanks and line ends: the body of OFF and ascii PLY.
#pragma once

#include <cstdint>
#include <string_view>

#include "ibmfair/io/characters.h"
#include "ibmfair/io/line_end.h"
#include "ibmfair/io/numbers.h"
#include "ibmfair/io/source_bytes.h"

namespace ibmfair {

/// Every number must be followed by a blank, the end of its line, or a comment if the format has
/// comments (from `#` to the end of the line; a blank before `#` is not required).
class TokenCursor {
 public:
  TokenCursor(const SourceBytes& source, const char* start, bool comments)
      : source_(source),
        p_(start),
        end_(source.end()),
        comment_(comments ? characters::hash : std::uint8_t{0}) {}

  /// Moves to the next token on this or a later line; false at the end of the text.
  bool skip_to_token() {
    skip_space();
    while (characters::is(*p_, comment_)) {
      skip_comment();
      skip_space();
    }
    return p_ != end_;
  }

  /// Whether only blanks or a comment follow on this line.
  bool at_line_end() {
    p_ = characters::find_not(p_, characters::blank);
    return characters::is(*p_, characters::line_end | comment_);
  }

  /// Moves past the end of this line, including a comment, and returns the line end. Returns an
  /// empty text if more follows on the line or if the text ends here.
  std::string_view take_line_end() {
    if (!at_line_end()) return {};
    skip_comment();
    const std::string_view line_end = leading_line_end({p_, static_cast<std::size_t>(end_ - p_)});
    p_ += line_end.size();
    return line_end;
  }

  /// The position of the cursor; after skip_to_token(), the start of a token.
  const char* position() const { return p_; }

  /// Reads a finite number; throws BadFile.
  double real() {
    double value = 0.0;
    if (!skip_to_token()) fail(p_, "the file ends before its last row does");
    const char* after = parse_real(p_, end_, value);
    if (after == nullptr || !characters::is(*after, token_end()))
      fail(p_, describe_bad_real(p_, end_));
    p_ = after;
    return value;
  }

  /// Reads an integer; throws BadFile.
  std::int64_t integer() {
    std::int64_t value = 0;
    if (!skip_to_token()) fail(p_, "the file ends before its last row does");
    const char* after = parse_integer(p_, end_, value);
    if (after == nullptr || !characters::is(*after, token_end())) fail(p_, "not an integer");
    p_ = after;
    return value;
  }

  /// Skips a token of any form and returns it.
  std::string_view token() {
    if (!skip_to_token()) fail(p_, "the file ends before its last row does");
    const char* start = p_;
    p_ = characters::find(start, token_end());
    return {start, static_cast<std::size_t>(p_ - start)};
  }

  /// Moves to the position of another cursor over the same text.
  void go_back(const TokenCursor& there) { p_ = there.p_; }

  /// The number of bytes between the cursor and the end of the text.
  std::int64_t remaining() const { return end_ - p_; }

  [[noreturn]] void fail(const char* where, std::string_view message) const {
    fail_in_text(source_, where, message);
  }

 private:
  std::uint8_t token_end() const { return characters::blank | characters::line_end | comment_; }

  void skip_space() {
    const char* p = p_;
    while (p != end_ && characters::is(*p, characters::blank | characters::line_end))
      ++p;
    p_ = p;
  }
  void skip_comment() { p_ = characters::find(p_, characters::line_end); }

  const SourceBytes& source_;
  const char* p_;
  const char* end_;
  std::uint8_t comment_;  // class of the character that starts a comment, or 0
};

}  // namespace ibmfair
