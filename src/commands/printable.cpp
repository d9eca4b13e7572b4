#include "commands/printable.h"

#include <algorithm>

#include <fmt/format.h>

namespace ibmfair::commands {

namespace {

using Character = char32_t;

/// Decodes the first character; returns its length in bytes, or 0 if it is not UTF-8.
std::size_t decode(std::string_view text, Character& character) {
  const auto first = static_cast<unsigned char>(text.front());
  const std::size_t length = first < 0x80                    ? 1
                             : first >= 0xc2 && first < 0xe0 ? 2
                             : first >= 0xe0 && first < 0xf0 ? 3
                             : first >= 0xf0 && first < 0xf5 ? 4
                                                             : 0;
  if (length == 0 || text.size() < length) {
    return 0;
  }
  character = length == 1 ? first : first & (0x7fU >> length);
  for (const char c : text.substr(1, length - 1)) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xc0U) != 0x80U) {
      return 0;
    }
    character = (character << 6U) | (byte & 0x3fU);
  }
  const bool overlong = (length == 3 && character < 0x800) || (length == 4 && character < 0x10000);
  const bool surrogate = character >= 0xd800 && character < 0xe000;
  return overlong || surrogate || character > 0x10ffff ? 0 : length;
}

bool is_control(Character c) {
  return c < 0x20 || (c >= 0x7f && c < 0xa0);
}

bool turns_direction(Character c) {
  return c == 0x61c || c == 0x200e || c == 0x200f || (c >= 0x2028 && c <= 0x202e) ||
         (c >= 0x2066 && c <= 0x2069);
}

}  // namespace

std::size_t visible_length(std::string_view text) {
  Character character = 0;
  const std::size_t length = decode(text, character);
  return is_control(character) || turns_direction(character) ? 0 : length;
}

bool is_printable(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = visible_length(text);
    if (length == 0) {
      return false;
    }
    text.remove_prefix(length);
  }
  return true;
}

std::string escaped_byte(char byte) {
  switch (byte) {
    case '\n':
      return "\\n";
    case '\t':
      return "\\t";
    default:
      return fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
  }
}

std::string printable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = visible_length(text);
    result += length > 0 ? std::string(text.substr(0, length)) : escaped_byte(text.front());
    text.remove_prefix(length > 0 ? length : 1);
  }
  return result;
}

std::string printable_json(std::string_view json) {
  std::string result;
  result.reserve(json.size());
  while (!json.empty()) {
    Character character = 0;
    const std::size_t length = std::max<std::size_t>(decode(json, character), 1);
    if (character == '\n' || !(is_control(character) || turns_direction(character))) {
      result += json.substr(0, length);
    } else {
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(character));
    }
    json.remove_prefix(length);
  }
  return result;
}

}  // namespace ibmfair::commands
