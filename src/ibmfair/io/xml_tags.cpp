#include "ibmfair/io/xml_tags.h"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/short_text.h"
#include "ibmfair/base/types.h"
#include "ibmfair/io/numbers.h"

namespace ibmfair {
namespace {

constexpr std::string_view blanks = " \t\r\n";
constexpr std::size_t deepest = 1000;

bool is_blank(char c) {
  return blanks.find(c) != std::string_view::npos;
}

std::string_view local_name(std::string_view name) {
  const std::size_t colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

}  // namespace

XmlTags::XmlTags(const SourceBytes& text)
    : source_(text), p_(text.begin()), end_(text.end()), start_(p_) {
  const std::string_view bytes = text.view();
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF") ||
      bytes.substr(0, 2).find('\0') != std::string_view::npos) {
    fail_in_file(text, "the text is UTF-16; save it as UTF-8");
  }
}

bool XmlTags::next() {
  if (empty_before_) open_.pop_back();
  empty_before_ = false;
  if (!skip_to_tag()) return false;
  start_ = p_++;
  attributes_.clear();
  if (p_ != end_ && *p_ == '/') {
    ++p_;
    name_ = local_name(word());
    skip_blanks();
    if (p_ == end_ || *p_++ != '>') fail("the tag does not end with '>'");
    kind_ = Kind::end;
    close();
    return true;
  }
  name_ = local_name(word());
  if (name_.empty()) fail("a tag without a name");
  read_attributes();
  if (open_.size() == deepest) fail("the elements are nested too deep");
  open_.push_back(name_);
  empty_before_ = is_empty();
  return true;
}

void XmlTags::close() {
  if (open_.empty() || open_.back() != name_) {
    fail(open_.empty() ? std::string("no element is open here")
                       : fmt::format("<{}> must be closed first", short_text(open_.back(), 40)));
  }
  open_.pop_back();
}

/// Skips everything up to the next start or end tag; false if there is none.
bool XmlTags::skip_to_tag() {
  while (true) {
    p_ = std::find(p_, end_, '<');
    if (p_ == end_) return false;
    const std::string_view rest(p_, static_cast<std::size_t>(end_ - p_));
    if (rest.starts_with("<!--")) {
      skip_behind("-->", "comment");
    } else if (rest.starts_with("<![CDATA[")) {
      skip_behind("]]>", "CDATA section");
    } else if (rest.starts_with("<?")) {
      skip_behind("?>", "processing instruction");
    } else if (rest.starts_with("<!")) {
      fail_at(p_, "document type definitions are not supported");
    } else {
      return true;
    }
  }
}

void XmlTags::skip_behind(std::string_view end, std::string_view what) {
  const std::string_view rest(p_, static_cast<std::size_t>(end_ - p_));
  const std::size_t at = rest.find(end);
  if (at == std::string_view::npos) fail_at(p_, fmt::format("the {} does not end", what));
  p_ += at + end.size();
}

std::string_view XmlTags::word() {
  const char* start = p_;
  while (p_ != end_ && !is_blank(*p_) && *p_ != '=' && *p_ != '>' && *p_ != '/' && *p_ != '<')
    ++p_;
  return {start, static_cast<std::size_t>(p_ - start)};
}

void XmlTags::skip_blanks() {
  while (p_ != end_ && is_blank(*p_))
    ++p_;
}

void XmlTags::read_attributes() {
  while (true) {
    skip_blanks();
    if (p_ == end_) fail("the text ends within this tag");
    if (*p_ == '>') {
      ++p_;
      kind_ = Kind::start;
      return;
    }
    if (*p_ == '/') {
      if (++p_ == end_ || *p_++ != '>') fail("the tag does not end with '/>'");
      kind_ = Kind::empty;
      return;
    }
    const std::string_view name = word();
    skip_blanks();
    if (name.empty() || p_ == end_ || *p_ != '=') fail("an attribute without a value");
    ++p_;
    skip_blanks();
    if (p_ == end_ || (*p_ != '"' && *p_ != '\'')) fail("the value of an attribute needs quotes");
    const char quote = *p_++;
    const char* start = p_;
    p_ = std::find(p_, end_, quote);
    if (p_ == end_) fail("the text ends within this tag");
    if (!name.starts_with("xmlns")) {
      attributes_.emplace_back(local_name(name),
                               std::string_view(start, static_cast<std::size_t>(p_ - start)));
    }
    ++p_;
  }
}

const XmlTags::Attribute* XmlTags::find(std::string_view attribute) const {
  const auto at = std::ranges::find(attributes_, attribute, &Attribute::first);
  return at == attributes_.end() ? nullptr : &*at;
}

std::string XmlTags::text(std::string_view attribute) const {
  static constexpr std::array<std::pair<std::string_view, char>, 5> entities{
      {{"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}}};
  const Attribute* found = find(attribute);
  std::string_view rest = found == nullptr ? std::string_view() : found->second;
  std::string text;
  while (!rest.empty()) {
    const auto* const entity = std::ranges::find_if(
        entities, [&](const auto& known) { return rest.starts_with(known.first); });
    const bool is_entity = entity != entities.end();
    text += is_entity ? entity->second : rest.front();
    rest.remove_prefix(is_entity ? entity->first.size() : 1);
  }
  return text;
}

std::string_view XmlTags::required(std::string_view attribute) const {
  const Attribute* found = find(attribute);
  if (found == nullptr) fail(fmt::format("the attribute '{}' is missing", attribute));
  std::string_view value = found->second;
  value.remove_prefix(std::min(value.find_first_not_of(blanks), value.size()));
  return value.substr(0, value.find_last_not_of(blanks) + 1);
}

double XmlTags::real(std::string_view attribute) const {
  const std::string_view value = required(attribute);
  const char* end = value.data() + value.size();
  double result = 0;
  if (parse_real(value.data(), end, result) != end) {
    fail_at(value.data(), fmt::format("{}: {}", attribute, describe_bad_real(value.data(), end)));
  }
  return result;
}

std::int64_t XmlTags::integer(std::string_view attribute) const {
  const std::string_view value = required(attribute);
  const char* end = value.data() + value.size();
  std::int64_t result = 0;
  if (parse_integer(value.data(), end, result) != end || result < 0 ||
      result > std::numeric_limits<Index>::max()) {
    fail_at(value.data(), fmt::format("{}: not a whole number from 0 to {}", attribute,
                                      std::numeric_limits<Index>::max()));
  }
  return result;
}

std::vector<double> XmlTags::reals(std::string_view attribute) const {
  std::string_view rest = required(attribute);
  std::vector<double> values;
  while (!rest.empty()) {
    const char* end = rest.data() + rest.size();
    double value = 0;
    const char* after = parse_real(rest.data(), end, value);
    if (after == nullptr || (after != end && !is_blank(*after))) {
      fail_at(rest.data(), fmt::format("{}: {}", attribute, describe_bad_real(rest.data(), end)));
    }
    values.push_back(value);
    rest.remove_prefix(static_cast<std::size_t>(after - rest.data()));
    rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size()));
  }
  return values;
}

void XmlTags::fail_at(const char* where, std::string_view message) const {
  fail_in_text(source_, where, message);
}

}  // namespace ibmfair
