#include "ibmfair/io/ply_body.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace ibmfair::ply {
namespace {

std::string out_of_range(std::int64_t index, std::int64_t limit) {
  return fmt::format("there is no vertex {} (the file has {}, counted from 0)", index, limit);
}

}  // namespace

double BinaryBody::any_real(Type type) {
  require(size_of(type));
  const double value = binary_number(p_, type, swapped_);
  p_ += size_of(type);
  return value;
}

double BinaryBody::real(Type type) {
  const double value = any_real(type);
  if (std::isfinite(value)) return value;
  p_ -= size_of(type);
  fail("not a finite number");
}

std::int64_t BinaryBody::count(const Property& list) {
  require(size_of(list.count_type));
  const std::int64_t count = with_type(list.count_type, [&](auto of) {
    return load_integer<typename decltype(of)::type>(p_, swapped_);
  });
  if (count < 0) fail("a list with a negative count");
  p_ += size_of(list.count_type);
  // A count has at most 32 bits, so the product cannot overflow.
  if (count * size_of(list.type) > end_ - p_) {
    fail(fmt::format("a list of {} values, but the file ends before it does", count));
  }
  return count;
}

void BinaryBody::indices(Type type, std::int64_t count, std::int64_t smallest, std::int64_t limit,
                         std::vector<Index>& out) {
  with_type(type, [&](auto of) {
    using T = typename decltype(of)::type;
    for (const char* last = p_ + count * sizeof(T); p_ != last; p_ += sizeof(T)) {
      const std::int64_t index = load_integer<T>(p_, swapped_);
      if (index < smallest || index >= limit) fail(out_of_range(index, limit));
      out.push_back(static_cast<Index>(index));
    }
  });
}

void BinaryBody::skip(const Property& property) {
  if (property.is_list) {
    p_ += count(property) * size_of(property.type);
  } else {
    require(size_of(property.type));
    p_ += size_of(property.type);
  }
}

void BinaryBody::skip_rows(const Element& element) {
  start_element(element);
  if (element.properties.empty()) return;
  if (!element.has_lists()) {
    // The header reader has checked that this cannot overflow.
    start_row(element.count);
    require(element.count * element.smallest_row());
    p_ += element.count * element.smallest_row();
    return;
  }
  for (std::int64_t row = 0; row < element.count; ++row) {
    start_row(row);
    for (const Property& property : element.properties)
      skip(property);
  }
}

double AsciiBody::any_real(Type /*type*/) {
  const std::string_view text = cursor_.token();
  double value = std::numeric_limits<double>::quiet_NaN();
  parse_real(text.data(), text.data() + text.size(), value);
  return value;
}

std::int64_t AsciiBody::count(const Property& /*list*/) {
  cursor_.skip_to_token();
  const char* where = cursor_.position();
  const std::int64_t count = cursor_.integer();
  if (count < 0) cursor_.fail(where, "a list with a negative count");
  if (count > cursor_.remaining()) cursor_.fail(where, "the file ends before the list does");
  return count;
}

void AsciiBody::indices(Type /*type*/, std::int64_t count, std::int64_t smallest,
                        std::int64_t limit, std::vector<Index>& out) {
  for (std::int64_t i = 0; i < count; ++i) {
    cursor_.skip_to_token();
    const char* where = cursor_.position();
    const std::int64_t index = cursor_.integer();
    if (index < smallest || index >= limit) cursor_.fail(where, out_of_range(index, limit));
    out.push_back(static_cast<Index>(index));
  }
}

void AsciiBody::skip(const Property& property) {
  const std::int64_t values = property.is_list ? count(property) : 1;
  for (std::int64_t i = 0; i < values; ++i)
    cursor_.token();
}

void AsciiBody::skip_rows(const Element& element) {
  if (element.properties.empty()) return;
  for (std::int64_t row = 0; row < element.count; ++row) {
    for (const Property& property : element.properties)
      skip(property);
    end_row();
  }
}

}  // namespace ibmfair::ply
