// Checks that an STL file is complete, and reads it through assimp, which says of a truncated file
// only that it knows no such format, or reads the triangles that are left without a word.
#include <algorithm>
#include <bit>
#include <cctype>
#include <cstdint>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/io/assimp_import.h"
#include "ibmfair/io/binary_bytes.h"
#include "ibmfair/io/source_bytes.h"
#include "ibmfair/io/stl.h"

namespace ibmfair::stl {
namespace {

constexpr std::size_t count_at = 80;  // behind a text of any contents
constexpr std::size_t smallest_file = 84;
constexpr std::size_t triangle_size = 50;

constexpr bool is_little_endian = std::endian::native == std::endian::little;

/// What assimp is given instead of the bytes of the file.
struct Body {
  std::string_view bytes;
  std::vector<std::string> warnings = {};
  std::string replaced = {};  ///< not empty: takes the place of `bytes`
};

/// Whether the text starts with this word, in any case, and a blank or line end behind it.
bool starts_with_word(std::string_view text, std::string_view word) {
  const auto same = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; };
  return text.size() >= word.size() &&
         std::equal(word.begin(), word.end(), text.begin(),
                    [&](char a, char b) { return same(b, a); }) &&
         (text.size() == word.size() ||
          std::isspace(static_cast<unsigned char>(text[word.size()])) != 0);
}

/// Binary files may also start with "solid", but have zero bytes soon.
bool is_text(std::string_view bytes) {
  constexpr std::size_t sample = 500;
  const std::size_t start = bytes.find_first_not_of(" \t\r\n");
  return start != std::string_view::npos && starts_with_word(bytes.substr(start), "solid") &&
         bytes.substr(0, sample).find('\0') == std::string_view::npos;
}

Body complete_binary(const SourceBytes& source) {
  const std::string_view bytes = source.view();
  if (bytes.empty()) fail_in_file(source, "the file is empty");
  if (bytes.size() < smallest_file) {
    fail_in_file(source, fmt::format("not an STL file: it neither starts with 'solid' nor has the "
                                     "{} bytes of a binary header (it has {})",
                                     smallest_file, bytes.size()));
  }
  const auto count = load<std::uint32_t>(bytes.data() + count_at, !is_little_endian);
  const std::size_t whole = smallest_file + triangle_size * std::size_t{count};
  if (bytes.size() < whole) {
    fail_in_file(source, fmt::format("the file is truncated (or no STL): of the {} triangles that "
                                     "its header announces, {} are there ({} of {} bytes)",
                                     count, (bytes.size() - smallest_file) / triangle_size,
                                     bytes.size(), whole));
  }
  Body body{bytes.substr(0, whole)};
  if (bytes.size() > whole) {
    body.warnings.push_back(
        fmt::format("{}: {} bytes behind the last of the {} triangles that the header announces "
                    "are not read",
                    source.name(), bytes.size() - whole, count));
  }
  return body;
}

/// The words of an ASCII file, without the names of its solids.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  /// The next word; empty at the end.
  std::string_view next() {
    skip([](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; });
    const std::size_t start = at_;
    skip([](char c) { return std::isspace(static_cast<unsigned char>(c)) == 0; });
    const std::string_view word = text_.substr(start, at_ - start);
    if (starts_with_word(word, "solid") || starts_with_word(word, "endsolid")) {
      skip([](char c) { return c != '\n' && c != '\r'; });
    }
    return word;
  }

 private:
  template <class Is>
  void skip(const Is& is) {
    while (at_ < text_.size() && is(text_[at_]))
      ++at_;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

/// The text with every byte replaced that is not ASCII, because assimp takes no text for STL that
/// has such bytes at its start, as a name in another alphabet does; empty if there is none.
std::string in_ascii(std::string_view text) {
  const auto foreign = [](char c) { return static_cast<unsigned char>(c) > 126; };
  if (std::ranges::none_of(text, foreign)) return {};
  std::string ascii(text);
  std::ranges::replace_if(ascii, foreign, '_');
  return ascii;
}

Body complete_text(const SourceBytes& source) {
  std::int64_t complete = 0;
  const char* open = nullptr;  // the last facet that has not ended
  bool ended = false;
  Words words(source.view());
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (starts_with_word(word, "facet")) {
      open = word.data();
      ended = false;
    } else if (starts_with_word(word, "endfacet")) {
      open = nullptr;
      ++complete;
    } else if (starts_with_word(word, "endsolid")) {
      ended = true;
    }
  }
  if (open != nullptr) {
    const TextPlace place = text_place(source, open);
    throw BadFile(
        fmt::format("{}:{}:{}: the file is truncated: it ends within the triangle that "
                    "begins here, after {} complete ones",
                    source.name(), place.line, place.column, complete));
  }
  Body body{source.view(), {}, in_ascii(source.view())};
  if (!ended) {
    body.warnings.push_back(
        fmt::format("{}: the file may be truncated: there is no 'endsolid' behind its {} triangles",
                    source.name(), complete));
  }
  return body;
}

}  // namespace

bool recognises(std::string_view bytes) {
  return bytes.starts_with("solid ");
}

ParsedMesh read(const SourceBytes& source, std::string_view extension) {
  Body body = is_text(source.view()) ? complete_text(source) : complete_binary(source);
  if (!body.replaced.empty()) body.bytes = body.replaced;
  ParsedMesh parsed =
      body.bytes.data() == source.begin() && body.bytes.size() == source.size()
          ? read_through_assimp(source, extension)
          : read_through_assimp(*SourceBytes::from_memory(source.name(), body.bytes), extension);
  parsed.warnings = std::move(body.warnings);
  return parsed;
}

}  // namespace ibmfair::stl
