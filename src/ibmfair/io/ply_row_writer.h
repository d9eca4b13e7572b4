// Writes the rows of a PLY body.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>
#include <type_traits>

#include "ibmfair/io/binary_bytes.h"
#include "ibmfair/io/byte_sink.h"
#include "ibmfair/io/numbers.h"
#include "ibmfair/io/ply_body.h"

namespace ibmfair::ply {

/// Writes values one after the other, as text separated by blanks or as bytes.
class RowWriter {
 public:
  RowWriter(ByteSink& out, Encoding encoding, std::string_view line_end = "\n")
      : out_(out),
        ascii_(encoding == Encoding::ascii),
        swapped_(is_swapped(encoding)),
        line_end_(line_end) {}

  template <class T>
  void value(T value) {
    if (!ascii_) return store(out_, value, swapped_);
    char buffer[number_text_capacity];
    verbatim(number_text(value, buffer));
  }

  /// Writes a number in the given type; an integer type gets the nearest value in its range, and 0
  /// for NaN.
  void number(Type type, double number) {
    with_type(type, [&](auto of) {
      using T = typename decltype(of)::type;
      if constexpr (std::is_floating_point_v<T>) {
        value(static_cast<T>(number));
      } else {
        const double low = std::numeric_limits<T>::min();
        const double high = std::numeric_limits<T>::max();
        value(std::isnan(number) ? T{0}
                                 : static_cast<T>(std::clamp(std::round(number), low, high)));
      }
    });
  }

  /// Writes a value or list exactly as it is stored in a body of the same encoding.
  void verbatim(std::string_view bytes) {
    if (ascii_ && !first_) out_.write(" ");
    first_ = false;
    out_.write(bytes);
  }

  void end_row() {
    if (ascii_) out_.write(line_end_);
    first_ = true;
  }

 private:
  ByteSink& out_;
  bool ascii_;
  bool swapped_;
  std::string_view line_end_;
  bool first_ = true;
};

}  // namespace ibmfair::ply
