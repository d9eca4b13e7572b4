// Classes of characters for the scanners of text files.
#pragma once

#include <array>
#include <cstdint>

namespace ibmfair::characters {

/// Classes of characters; combine several with `|`.
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

/// The first character from `p` on that is in the class (find) or is not (find_not). There is no
/// check for the end of the text: the bytes of a file (io/source_bytes.h) are followed by a line
/// feed, which ends every search for the end of a line.
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
