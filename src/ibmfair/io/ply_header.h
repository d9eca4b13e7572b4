// The header of a PLY file: which elements follow, and how their properties are stored.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ibmfair/io/source_bytes.h"

namespace ibmfair::ply {

enum class Type : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes of one value of a type: 1, 2, 4 or 8.
constexpr int size_of(Type type) {
  constexpr std::array<int, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

constexpr bool is_real(Type type) {
  return type == Type::float32 || type == Type::float64;
}

/// A scalar, or a list: a count followed by that many values.
struct Property {
  std::string name;
  Type type = Type::float32;
  bool is_list = false;
  Type count_type = Type::uint8;
  std::string_view line;       ///< its header line, end of line included
  std::string_view type_text;  ///< the type's name within that line
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties;
  std::string_view count_text;  ///< the count as the header gives it

  bool has_lists() const;
  /// Bytes of a binary row whose lists are all empty; the size of every row if there are none.
  std::int64_t smallest_row() const;
  /// The position of a property, -1 if there is none. Throws BadFile if there are several.
  int find(const SourceBytes& source, std::string_view property) const;
};

enum class Encoding : std::uint8_t { ascii, little_endian, big_endian };

struct Header {
  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;  ///< no two of one name
  std::vector<std::string> comments;
  const char* body = nullptr;  ///< the first byte after the header

  /// The element of this name, nullptr if there is none.
  const Element* find(std::string_view name) const;
};

/// Reads the header and checks that the file is long enough for the rows that it announces, before
/// anything is allocated for them. Throws BadFile.
Header read_header(const SourceBytes& source);

/// Reads a header whose rows stand elsewhere. Throws BadFile.
Header read_lone_header(const SourceBytes& source);

}  // namespace ibmfair::ply
