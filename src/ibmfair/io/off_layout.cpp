// Reads the header of an OFF file and determines its variant.
#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "ibmfair/io/off.h"
#include "ibmfair/io/token_cursor.h"

namespace ibmfair::off {
namespace {

/// Reads the letters before "OFF", which state what the vertices have.
void read_prefix(const SourceBytes& source, std::string_view prefix, Layout& layout) {
  const char* where = prefix.data();
  while (!prefix.empty()) {
    std::size_t length = 1;
    if (prefix.starts_with("ST")) {
      layout.texture = true;
      length = 2;
    } else if (prefix.front() == 'C') {
      layout.colour = true;
    } else if (prefix.front() == 'N') {
      layout.normal = true;
    } else if (prefix.front() == '4' || prefix.front() == 'n') {
      fail_in_text(source, where, "points of other than three dimensions are not supported");
    } else {
      fail_in_text(source, where, "not an OFF file");
    }
    prefix.remove_prefix(length);
  }
}

/// Reads the keyword, if there is one, and returns the start of the counts. The first count may
/// follow the keyword without a blank.
const char* read_keyword(const SourceBytes& source, TokenCursor& cursor, Layout& layout) {
  if (!cursor.skip_to_token()) fail_in_file(source, "the file is empty");
  const char* start = cursor.position();
  const std::string_view word = cursor.token();
  const std::size_t off = word.find("OFF");
  if (off == std::string_view::npos) {
    if (word.front() < '0' || word.front() > '9') {
      fail_in_text(source, start, "not an OFF file: neither a keyword nor counts");
    }
    return start;
  }
  read_prefix(source, word.substr(0, off), layout);
  if (off + 3 == word.size() && !cursor.at_line_end() && cursor.token() == "BINARY") {
    layout.binary = true;
    return cursor.position();
  }
  return start + off + 3;
}

/// The number of colour channels, three or four, which only the first row shows.
int count_colour_channels(const SourceBytes& source, const Layout& layout) {
  TokenCursor cursor(source, layout.body, true);
  if (!cursor.skip_to_token()) return 4;
  int columns = 0;
  for (; !cursor.at_line_end() && columns < 16; ++columns)
    cursor.token();
  return columns - 3 - (layout.normal ? 3 : 0) - (layout.texture ? 2 : 0) == 3 ? 3 : 4;
}

std::int64_t read_integer(TokenCursor& cursor, std::string_view& text) {
  cursor.skip_to_token();
  const char* where = cursor.position();
  const std::int64_t value = cursor.integer();
  text = {where, static_cast<std::size_t>(cursor.position() - where)};
  return value;
}

std::int64_t read_count(TokenCursor& cursor, std::int64_t smallest_row, std::string_view rows,
                        std::string_view& text) {
  const std::int64_t count = read_integer(cursor, text);
  const char* where = text.data();
  if (count < 0) cursor.fail(where, fmt::format("a negative number of {}", rows));
  // The separator after the last row may be missing.
  if (count > (cursor.remaining() + 1) / smallest_row) {
    cursor.fail(where, fmt::format("the file is too short for that many {}:", rows));
  }
  if (count > std::numeric_limits<Index>::max()) {
    cursor.fail(where, fmt::format("too many {}", rows));
  }
  return count;
}

void skip_line_end(const SourceBytes& source, Layout& layout, const char* p) {
  while (p != source.end() && *p != '\n')
    ++p;
  if (p == source.end()) fail_in_text(source, p, "the header does not end");
  layout.body = p + 1;
}

}  // namespace

Layout read_layout(const SourceBytes& source) {
  Layout layout;
  TokenCursor header(source, source.begin(), true);
  const char* counts = read_keyword(source, header, layout);
  if (layout.binary) {
    if (layout.colour) layout.colour_channels = 4;
    skip_line_end(source, layout, counts);
    return layout;
  }
  TokenCursor cursor(source, counts, true);
  constexpr int smallest_vertex = 6;  // "0 0 0" and a separator
  constexpr int smallest_face = 8;    // "3 0 1 2" and a separator
  layout.vertex_count = read_count(cursor, smallest_vertex, "vertices", layout.count_texts[0]);
  layout.face_count = read_count(cursor, smallest_face, "faces", layout.count_texts[1]);
  if (!cursor.at_line_end()) layout.edge_count = read_integer(cursor, layout.count_texts[2]);
  layout.body = cursor.position();
  if (layout.colour) layout.colour_channels = count_colour_channels(source, layout);
  return layout;
}

bool recognises(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::size_t stop = std::min(bytes.find_first_of("\r\n"), bytes.size());
    const std::string_view line = bytes.substr(0, stop);
    const std::size_t first = line.find_first_not_of(" \t");
    if (first != std::string_view::npos && line[first] != '#') {
      const std::size_t keyword = line.find("OFF");
      return keyword != std::string_view::npos && keyword - first <= 5;
    }
    bytes.remove_prefix(std::min(stop + 1, bytes.size()));
  }
  return false;
}

}  // namespace ibmfair::off
