// The header of a PLY file: its elements, and how their properties are stored.
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

/// The number of bytes of one value of a type: 1, 2, 4 or 8.
constexpr int size_of(Type type) {
  constexpr std::array<int, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

constexpr bool is_real(Type type) {
  return type == Type::float32 || type == Type::float64;
}

/// A scalar property, or a list: a count followed by that many values.
struct Property {
  std::string name;
  Type type = Type::float32;
  bool is_list = false;
  Type count_type = Type::uint8;
  std::string_view line;       ///< the line in the header, including its line end
  std::string_view type_text;  ///< the name of the type within that line
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties;
  std::string_view count_text;  ///< the count as written in the header

  bool has_lists() const;
  /// The number of bytes of a binary row with empty lists; if there are no lists, every row has
  /// this size.
  std::int64_t smallest_row() const;
  /// The position of the property of this name, -1 if there is none. Throws BadFile if there are
  /// several.
  int find(const SourceBytes& source, std::string_view property) const;
};

enum class Encoding : std::uint8_t { ascii, little_endian, big_endian };

struct Header {
  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;  ///< no two have the same name
  std::vector<std::string> comments;
  const char* body = nullptr;  ///< the first byte after the header

  /// The element with this name, nullptr if there is none.
  const Element* find(std::string_view name) const;
};

/// Reads the header and checks that the file is long enough for the rows that the header declares,
/// before memory is allocated for them. Throws BadFile.
Header read_header(const SourceBytes& source);

/// Reads a header whose rows are stored elsewhere, so without this check. Throws BadFile.
Header read_lone_header(const SourceBytes& source);

}  // namespace ibmfair::ply
