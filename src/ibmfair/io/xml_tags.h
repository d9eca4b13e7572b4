// Reads the tags of an XML text one after the other, as much as formats need that hold their data
// in attributes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ibmfair/io/source_bytes.h"

namespace ibmfair {

/// Text between tags, comments, CDATA and processing instructions are skipped. Names are without
/// the prefix of their name space. A document type definition is refused: it could define entities
/// without end.
class XmlTags {
 public:
  /// Throws BadFile for a text in UTF-16.
  explicit XmlTags(const SourceBytes& text);

  /// Advances to the next tag; false at the end of the text. Throws BadFile for a malformed tag and
  /// for an end tag that does not belong to the last open element.
  bool next();

  std::string_view name() const { return name_; }
  bool is_end() const { return kind_ == Kind::end; }      ///< `</name>`
  bool is_start() const { return kind_ != Kind::end; }    ///< `<name>` or `<name/>`
  bool is_empty() const { return kind_ == Kind::empty; }  ///< `<name/>`

  bool has(std::string_view attribute) const { return find(attribute) != nullptr; }

  /// The value of an attribute with its entities replaced; empty if there is none.
  std::string text(std::string_view attribute) const;

  /// The value as a number; throws BadFile if there is none, or if it is no number. An integer is
  /// from 0 to the largest Index.
  double real(std::string_view attribute) const;
  std::int64_t integer(std::string_view attribute) const;

  /// The value as numbers separated by blanks.
  std::vector<double> reals(std::string_view attribute) const;

  /// Throws BadFile with the place of this tag.
  [[noreturn]] void fail(std::string_view message) const { fail_at(start_, message); }

 private:
  enum class Kind : std::uint8_t { start, empty, end };
  using Attribute = std::pair<std::string_view, std::string_view>;  // name, value

  const Attribute* find(std::string_view attribute) const;
  std::string_view required(std::string_view attribute) const;
  bool skip_to_tag();
  void skip_behind(std::string_view end, std::string_view what);
  std::string_view word();
  void skip_blanks();
  void read_attributes();
  void close();
  [[noreturn]] void fail_at(const char* where, std::string_view message) const;

  const SourceBytes& source_;
  const char* p_;
  const char* end_;
  const char* start_;
  Kind kind_ = Kind::start;
  bool empty_before_ = false;  // the tag before was an empty element
  std::string_view name_;
  std::vector<Attribute> attributes_;
  std::vector<std::string_view> open_;
};

}  // namespace ibmfair
