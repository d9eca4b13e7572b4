#include "ibmfair/io/ply_header.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "ibmfair/io/numbers.h"

namespace ibmfair::ply {
namespace {

constexpr std::array<std::pair<std::string_view, Type>, 16> type_names{{
    {"char", Type::int8},
    {"uchar", Type::uint8},
    {"short", Type::int16},
    {"ushort", Type::uint16},
    {"int", Type::int32},
    {"uint", Type::uint32},
    {"float", Type::float32},
    {"double", Type::float64},
    {"int8", Type::int8},
    {"uint8", Type::uint8},
    {"int16", Type::int16},
    {"uint16", Type::uint16},
    {"int32", Type::int32},
    {"uint32", Type::uint32},
    {"float32", Type::float32},
    {"float64", Type::float64},
}};

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

/// Reads the header line by line. The first line end decides whether lines end with CR or with LF:
/// after a header with lines that end with CR, a binary body may begin with the byte LF, and vice
/// versa.
class HeaderReader {
 public:
  explicit HeaderReader(const SourceBytes& source) : source_(source), next_(source.begin()) {
    const std::size_t first = source.view().find_first_of("\r\n");
    const std::string_view text = source.view();
    if (first != std::string_view::npos && text[first] == '\r' &&
        (first + 1 == text.size() || text[first + 1] != '\n')) {
      line_end_ = '\r';
    }
  }

  Header run() {
    next_line();
    if (word() != "ply") fail_in_text(source_, source_.begin(), "a PLY file starts with 'ply'");
    while (true) {
      if (!next_line()) fail_in_text(source_, source_.end(), "the header has no 'end_header'");
      const std::string_view keyword = word();
      if (keyword == "end_header") break;
      read_line(keyword);
    }
    if (!has_format_) fail_in_text(source_, line_start_, "the header has no 'format' line");
    header_.body = next_;
    return std::move(header_);
  }

 private:
  bool next_line() {
    if (next_ == source_.end()) return false;
    line_start_ = next_;
    at_ = next_;
    stop_ = std::find(next_, source_.end(), line_end_);
    next_ = stop_ == source_.end() ? stop_ : stop_ + 1;
    return true;
  }

  std::string_view word() {
    while (at_ != stop_ && is_blank(*at_))
      ++at_;
    word_ = at_;
    while (at_ != stop_ && !is_blank(*at_))
      ++at_;
    return {word_, static_cast<std::size_t>(at_ - word_)};
  }

  [[noreturn]] void fail(std::string_view message) const { fail_in_text(source_, word_, message); }

  void read_line(std::string_view keyword) {
    if (keyword == "format") {
      read_format();
    } else if (keyword == "element") {
      read_element();
    } else if (keyword == "property") {
      read_property();
    } else if (keyword == "comment" || keyword == "obj_info") {
      header_.comments.emplace_back(at_, stop_);
    } else if (!keyword.empty() && !header_.elements.empty()) {
      // Before the elements, an unknown line is harmless; some exporters break comments over
      // several lines. Later, it may be a property, without which all rows would be misread.
      fail("unknown header line");
    }
  }

  void read_format() {
    const std::string_view format = word();
    has_format_ = true;
    if (format == "ascii") {
      header_.encoding = Encoding::ascii;
    } else if (format == "binary_little_endian") {
      header_.encoding = Encoding::little_endian;
    } else if (format == "binary_big_endian") {
      header_.encoding = Encoding::big_endian;
    } else {
      fail("unknown format");
    }
  }

  void read_element() {
    Element element;
    element.name = word();
    if (element.name.empty()) fail("an element needs a name");
    if (header_.find(element.name) != nullptr) fail("an element may be declared once only");
    const std::string_view count = word();
    const char* stop = count.data() + count.size();
    element.count_text = count;
    if (parse_integer(count.data(), stop, element.count) != stop || count.empty()) {
      fail("the element's count is not an integer");
    }
    if (element.count < 0) fail("the element's count is negative");
    header_.elements.push_back(std::move(element));
  }

  void read_property() {
    if (header_.elements.empty()) fail("a property before the first element");
    Property property;
    property.line = {line_start_, static_cast<std::size_t>(next_ - line_start_)};
    std::string_view type = word();
    if (type == "list") {
      property.is_list = true;
      property.count_type = read_type(word());
      if (is_real(property.count_type)) fail("the count of a list must be an integer");
      type = word();
    }
    property.type_text = type;
    property.type = read_type(type);
    property.name = word();
    if (property.name.empty()) fail("a property needs a name");
    header_.elements.back().properties.push_back(std::move(property));
  }

  Type read_type(std::string_view name) const {
    for (const auto& [known, type] : type_names) {
      if (name == known) return type;
    }
    fail("unknown type");
  }

  const SourceBytes& source_;
  Header header_;
  bool has_format_ = false;
  char line_end_ = '\n';
  const char* line_start_ = nullptr;  // the start of the current line
  const char* stop_ = nullptr;        // end of the current line, before its line end
  const char* next_ = nullptr;        // the start of the next line
  const char* at_ = nullptr;          // the end of the current word
  const char* word_ = nullptr;        // the start of the current word
};

/// Checks each count against the size of the file. In a text, every value takes at least a digit
/// and a separator.
void require_room(const SourceBytes& source, const Header& header) {
  const std::int64_t room = source.end() - header.body;
  for (const Element& element : header.elements) {
    const std::int64_t row = header.encoding == Encoding::ascii
                                 ? 2 * static_cast<std::int64_t>(element.properties.size())
                                 : element.smallest_row();
    // The separator after the last row may be missing.
    if (row > 0 && element.count > (room + 1) / row) {
      fail_in_text(source, element.count_text.data(),
                   fmt::format("the file is too short for that many rows of '{}' (it ends {} bytes "
                               "after the header):",
                               element.name, room));
    }
    if (element.count > std::numeric_limits<std::int32_t>::max()) {
      fail_in_text(source, element.count_text.data(), "too many rows");
    }
  }
}

}  // namespace

bool Element::has_lists() const {
  return std::any_of(properties.begin(), properties.end(),
                     [](const Property& property) { return property.is_list; });
}

std::int64_t Element::smallest_row() const {
  std::int64_t bytes = 0;
  for (const Property& property : properties) {
    bytes += size_of(property.is_list ? property.count_type : property.type);
  }
  return bytes;
}

int Element::find(const SourceBytes& source, std::string_view property) const {
  int found = -1;
  for (std::size_t i = 0; i < properties.size(); ++i) {
    if (properties[i].name != property) continue;
    if (found >= 0) {
      fail_in_text(source, properties[i].line.data(),
                   fmt::format("'{}' has two properties '{}':", name, property));
    }
    found = static_cast<int>(i);
  }
  return found;
}

const Element* Header::find(std::string_view name) const {
  for (const Element& element : elements) {
    if (element.name == name) return &element;
  }
  return nullptr;
}

Header read_header(const SourceBytes& source) {
  Header header = HeaderReader(source).run();
  require_room(source, header);
  return header;
}

Header read_lone_header(const SourceBytes& source) {
  return HeaderReader(source).run();
}

}  // namespace ibmfair::ply
