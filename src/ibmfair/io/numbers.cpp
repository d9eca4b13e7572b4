#include "ibmfair/io/numbers.h"

#include <algorithm>
#include <limits>

namespace ibmfair {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Skips a plus sign before a number, which std::from_chars does not accept. A sign after the plus,
/// as in "+-1", is not accepted.
const char* skip_plus(const char* p, const char* end) {
  return p != end && *p == '+' && p + 1 != end && (is_digit(p[1]) || p[1] == '.') ? p + 1 : p;
}

/// The power of ten of the leading digit of a number that is out of range for std::from_chars.
std::int64_t decimal_magnitude(const char* p, const char* end) {
  std::int64_t magnitude = 0;
  bool after_point = false;
  bool significant = false;
  if (p != end && *p == '-') ++p;
  for (; p != end && (is_digit(*p) || *p == '.'); ++p) {
    if (*p == '.') {
      after_point = true;
      continue;
    }
    significant = significant || *p != '0';
    if (significant && !after_point) ++magnitude;
    if (!significant && after_point) --magnitude;
  }
  std::int64_t exponent = 0;
  if (p != end && (*p == 'e' || *p == 'E')) parse_integer(p + 1, end, exponent);
  constexpr std::int64_t far = std::numeric_limits<std::int64_t>::max() / 2;
  return magnitude + std::clamp(exponent, -far, far);
}

}  // namespace

const char* detail::parse_unusual_real(const char* p, const char* end, double& value) {
  p = skip_plus(p, end);
  const auto [after, error] = std::from_chars(p, end, value);
  if (error == std::errc::result_out_of_range && decimal_magnitude(p, after) < 0) {
    value = *p == '-' ? -0.0 : 0.0;
    return after;
  }
  return error == std::errc() && std::isfinite(value) ? after : nullptr;
}

const char* detail::parse_unusual_integer(const char* p, const char* end, std::int64_t& value) {
  const bool negative = p != end && *p == '-';
  if (p != end && (*p == '-' || *p == '+')) ++p;
  if (p == end || !is_digit(*p)) return nullptr;
  constexpr std::int64_t largest = std::numeric_limits<std::int64_t>::max();
  std::int64_t result = 0;
  for (; p != end && is_digit(*p); ++p) {
    const std::int64_t digit = *p - '0';
    result = result > (largest - digit) / 10 ? largest : 10 * result + digit;
  }
  value = negative ? -result : result;
  return p;
}

std::string_view describe_bad_real(const char* p, const char* end) {
  double value = 0.0;
  p = skip_plus(p, end);
  const auto [after, error] = std::from_chars(p, end, value);
  if (error == std::errc::result_out_of_range) return "number too large for double precision";
  if (error == std::errc()) {
    return std::isfinite(value) ? "not a number" : "not a finite number";
  }
  return p == end || *p == ' ' || (*p >= '\t' && *p <= '\r') ? "a number is missing"
                                                             : "not a number";
}

void append_real(std::string& text, double value) {
  char buffer[number_text_capacity];
  text += number_text(value, buffer);
}

void append_integer(std::string& text, std::int64_t value) {
  char buffer[number_text_capacity];
  text += number_text(value, buffer);
}

}  // namespace ibmfair
