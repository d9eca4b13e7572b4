// Conversion between numbers and text: exact in both directions, independent of the locale, without
// allocation.
#pragma once

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>

namespace ibmfair {

namespace detail {
/// The slow path of parse_real: a number too small for a double becomes zero; for everything else
/// that std::from_chars rejects or that is not finite, returns nullptr.
const char* parse_unusual_real(const char* p, const char* end, double& value);

/// The slow path of parse_integer, for signs and for numbers with more digits than 64 bits can
/// hold.
const char* parse_unusual_integer(const char* p, const char* end, std::int64_t& value);
}  // namespace detail

/// Reads the finite number that starts at `p` ("+1", ".5" and "1e-400", which is 0, included).
/// Returns the end of the number, or nullptr if there is none.
inline const char* parse_real(const char* p, const char* end, double& value) {
  const auto [after, error] = std::from_chars(p, end, value);
  if (error == std::errc() && std::isfinite(value)) return after;
  return detail::parse_unusual_real(p, end, value);
}

/// The finite number at the start of the text, or 0 if there is none.
inline double real_or_zero(std::string_view text) {
  double value = 0.0;
  return parse_real(text.data(), text.data() + text.size(), value) != nullptr ? value : 0.0;
}

/// Reads the integer that starts at `p`, with or without a sign. Returns the end of the number, or
/// nullptr if there is none. A value outside the range of 64 bits becomes the nearest one inside.
inline const char* parse_integer(const char* p, const char* end, std::int64_t& value) {
  constexpr std::ptrdiff_t most_safe_digits = 18;
  const char* start = p;
  std::int64_t result = 0;
  // The unsigned comparison rejects characters both below '0' and above '9'.
  for (unsigned digit; p != end && (digit = static_cast<unsigned char>(*p) - unsigned{'0'}) < 10;
       ++p) {
    if (p - start == most_safe_digits) return detail::parse_unusual_integer(start, end, value);
    result = 10 * result + digit;
  }
  if (p == start) return detail::parse_unusual_integer(start, end, value);
  value = result;
  return p;
}

/// The reason why parse_real rejected the number at `p`, as a message for the user.
std::string_view describe_bad_real(const char* p, const char* end);

/// The space for the longest text that number_text() returns, "-2.2250738585072014e-308".
constexpr std::size_t number_text_capacity = 32;

/// The shortest text that reads back as the same number. The result points into `buffer`.
template <class Number>
std::string_view number_text(Number value, char (&buffer)[number_text_capacity]) {
  const auto result = std::to_chars(buffer, buffer + number_text_capacity, value);
  return {buffer, static_cast<std::size_t>(result.ptr - buffer)};
}

/// Appends the shortest text that reads back as `value`.
void append_real(std::string& text, double value);

/// Appends a decimal integer.
void append_integer(std::string& text, std::int64_t value);

}  // namespace ibmfair
