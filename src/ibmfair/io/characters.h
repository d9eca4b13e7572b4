// What the characters of a text file are to its scanners.
#pragma once

#include <array>
#include <cstdint>

namespace ibmfair::characters {

/// Kinds, of which several can be asked for at once.
inline constexpr std::uint8_t blank = 1;
inline constexpr std::uint8_t line_end = 2;
inline constexpr std::uint8_t hash = 4;
inline constexpr std::uint8_t backslash = 8;

inline constexpr std::array<std::uint8_t, 256> kinds = [] {
  std::array<std::uint8_t, 256> table{};
  for (const unsigned char c : {' ', '\t', '\v', '\f'})
    table[c] = blank;
  for (const unsigned char c : {'\n', '\r'})
    table[c] = line_end;
  table['#'] = hash;
  table['\\'] = backslash;
  return table;
}();

inline bool is(char c, std::uint8_t kind) {
  return (kinds[static_cast<unsigned char>(c)] & kind) != 0;
}

/// The first character from `p` on that is of this kind, or that is not. The bytes of a file
/// (io/source_bytes.h) end with a line feed: a search for an end of line needs no other end.
inline const char* find(const char* p, std::uint8_t kind) {
  while (!is(*p, kind))
    ++p;
  return p;
}
inline const char* find_not(const char* p, std::uint8_t kind) {
  while (is(*p, kind))
    ++p;
  return p;
}

}  // namespace ibmfair::characters
