// Writes OBJ text line by line.
#pragma once

#include <charconv>
#include <span>
#include <string_view>

#include "ibmfair/base/types.h"
#include "ibmfair/io/byte_sink.h"

namespace ibmfair::obj {

/// The references of a face corner, with rows counted from 0; -1 for none.
struct Corner {
  Index vertex = -1;
  Index texture = -1;
  Index normal = -1;
};

class ObjLines {
 public:
  ObjLines(ByteSink& out, std::string_view line_end) : out_(out), line_end_(line_end) {}

  /// Writes a line with a keyword and numbers.
  void row(std::string_view keyword, std::span<const double> values) {
    out_.write(keyword);
    for (const double value : values) {
      out_.write(" ");
      out_.write_real(value);
    }
    out_.write(line_end_);
  }

  /// Writes a line unchanged. If the line ends with a backslash, a blank is added so that the next
  /// line does not continue it.
  void statement(std::string_view text) {
    out_.write(text);
    if (text.ends_with('\\')) out_.write(" ");
    out_.write(line_end_);
  }

  void begin_face() { out_.write("f"); }
  void corner(const Corner& corner) {
    out_.write(" ");
    reference(corner.vertex);
    if (corner.texture >= 0 || corner.normal >= 0) out_.write("/");
    if (corner.texture >= 0) reference(corner.texture);
    if (corner.normal < 0) return;
    out_.write("/");
    reference(corner.normal);
  }
  void end_face() { out_.write(line_end_); }

 private:
  void reference(Index row) {
    char text[16];
    const auto result = std::to_chars(text, text + sizeof text, std::int64_t{row} + 1);
    out_.write({text, static_cast<std::size_t>(result.ptr - text)});
  }

  ByteSink& out_;
  std::string_view line_end_;
};

}  // namespace ibmfair::obj
