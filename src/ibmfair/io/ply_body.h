// Reads the rows of a PLY body value by value. The ascii and the binary body have the same member
// functions, so that a reader can be a template that works on both.
#pragma once

#include <bit>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/io/binary_bytes.h"
#include "ibmfair/io/ply_header.h"
#include "ibmfair/io/token_cursor.h"

namespace ibmfair::ply {

/// Calls f(std::type_identity<T>) with the C++ type T of `type`.
template <class F>
decltype(auto) with_type(Type type, F&& f) {
  switch (type) {
    case Type::int8:
      return f(std::type_identity<std::int8_t>());
    case Type::uint8:
      return f(std::type_identity<std::uint8_t>());
    case Type::int16:
      return f(std::type_identity<std::int16_t>());
    case Type::uint16:
      return f(std::type_identity<std::uint16_t>());
    case Type::int32:
      return f(std::type_identity<std::int32_t>());
    case Type::uint32:
      return f(std::type_identity<std::uint32_t>());
    case Type::float32:
      return f(std::type_identity<float>());
    default:
      return f(std::type_identity<double>());
  }
}

/// Whether numbers in this encoding have the opposite of this machine's byte order.
inline bool is_swapped(Encoding encoding) {
  const bool big = std::endian::native == std::endian::big;
  return encoding != Encoding::ascii && (encoding == Encoding::big_endian) != big;
}

/// The number of this type stored at `p`, with its bytes in reverse order if `swapped`.
inline double binary_number(const char* p, Type type, bool swapped) {
  return with_type(type, [&](auto of) {
    return static_cast<double>(load<typename decltype(of)::type>(p, swapped));
  });
}

/// The common part of both bodies: they know the current element and row, for error messages.
class BodyBase {
 public:
  void start_element(const Element& element) { element_ = &element; }
  void start_row(std::int64_t row) { row_ = row; }

 protected:
  const Element* element_ = nullptr;
  std::int64_t row_ = 0;
};

/// The rows of a binary body. Every member throws BadFile if the file ends early or a value is not
/// valid.
class BinaryBody : public BodyBase {
 public:
  BinaryBody(const SourceBytes& source, const Header& header)
      : source_(source),
        p_(header.body),
        end_(source.end()),
        swapped_(is_swapped(header.encoding)) {}

  /// The start of the next value, and the end of the last one.
  const char* position() const { return p_; }
  const char* after_value() const { return p_; }

  /// Reads a scalar that must be a finite number.
  double real(Type type);
  /// Reads a scalar, which may be NaN or infinite.
  double any_real(Type type);
  /// Reads the count of a list, and checks that the file has room for that many values.
  std::int64_t count(const Property& list);
  /// Reads `count` vertex numbers, each at least `smallest` and less than `limit`, and appends
  /// them.
  void indices(Type type, std::int64_t count, std::int64_t smallest, std::int64_t limit,
               std::vector<Index>& out);
  void skip(const Property& property);
  void skip_rows(const Element& element);
  void end_row() {}
  std::string_view take_line_end() { return {}; }

  [[noreturn]] void fail(std::string_view message) const {
    fail_in_binary(source_, element_->name, row_, p_, message);
  }

 private:
  void require(std::int64_t bytes) const {
    if (end_ - p_ < bytes) fail("the file ends here");
  }

  const SourceBytes& source_;
  const char* p_;
  const char* end_;
  bool swapped_;
};

/// The rows of an ascii body. Each row starts on a new line; blank lines are skipped.
class AsciiBody : public BodyBase {
 public:
  AsciiBody(const SourceBytes& source, const Header& header)
      : cursor_(source, header.body, false) {}

  /// The start of the next value, and the end of the last one.
  const char* position() {
    cursor_.skip_to_token();
    return cursor_.position();
  }
  const char* after_value() const { return cursor_.position(); }

  /// Reads a scalar that must be a finite number.
  double real(Type /*type*/) { return cursor_.real(); }
  /// Reads a scalar of any form; NaN if it is not a finite number.
  double any_real(Type type);
  std::int64_t count(const Property& list);
  void indices(Type type, std::int64_t count, std::int64_t smallest, std::int64_t limit,
               std::vector<Index>& out);
  void skip(const Property& property);
  void skip_rows(const Element& element);
  void end_row() {
    if (!cursor_.at_line_end()) {
      cursor_.fail(cursor_.position(), "the row has more values than the header declares");
    }
  }

  /// Moves past the end of the row's line and returns the line end; empty at the end of the file.
  std::string_view take_line_end() { return cursor_.take_line_end(); }

  [[noreturn]] void fail(std::string_view message) {
    cursor_.skip_to_token();
    cursor_.fail(cursor_.position(), message);
  }

 private:
  TokenCursor cursor_;
};

/// Calls f(body) with the body of the file, before its first row.
template <class F>
void with_body(const SourceBytes& source, const Header& header, F&& f) {
  if (header.encoding == Encoding::ascii) {
    f(AsciiBody(source, header));
  } else {
    f(BinaryBody(source, header));
  }
}

/// Reads all rows of an element: calls read(row, i) for each property i, which returns false,
/// having read nothing, if its value is to be skipped.
template <class Body, class Read>
void read_rows(Body& body, const Element& element, const Read& read) {
  body.start_element(element);
  for (std::int64_t row = 0; row < element.count; ++row) {
    body.start_row(row);
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      if (!read(row, i)) body.skip(element.properties[i]);
    }
    body.end_row();
  }
}

}  // namespace ibmfair::ply
