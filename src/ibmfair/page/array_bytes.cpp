#include "ibmfair/page/array_bytes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

namespace ibmfair {
namespace {

static_assert(std::endian::native == std::endian::little);

float with_fewer_bits(double value) {
  constexpr double most = std::numeric_limits<float>::max() / 2;  // rounding must not overflow
  if (std::isnan(value)) {
    return std::numeric_limits<float>::quiet_NaN();
  }
  constexpr std::uint32_t dropped = 23 - 11;  // bits of the mantissa
  const auto bits =
      std::bit_cast<std::uint32_t>(static_cast<float>(std::clamp(value, -most, most)));
  return std::bit_cast<float>(((bits >> (dropped - 1)) + 1) >> 1U << dropped);
}

}  // namespace

ArrayPlace ArrayBytes::append(std::string_view type, const void* data, std::size_t count,
                              std::size_t size) {
  const ArrayPlace place{type, static_cast<std::int64_t>(bytes_.size()),
                         static_cast<std::int64_t>(count)};
  bytes_.append(static_cast<const char*>(data), count * size);
  bytes_.resize((bytes_.size() + 3) / 4 * 4);
  return place;
}

ArrayPlace ArrayBytes::add(std::span<const float> numbers) {
  return append("float32", numbers.data(), numbers.size(), sizeof(float));
}

ArrayPlace ArrayBytes::add(std::span<const std::uint32_t> numbers) {
  return append("uint32", numbers.data(), numbers.size(), sizeof(std::uint32_t));
}

ArrayPlace ArrayBytes::add(std::span<const std::uint8_t> numbers) {
  return append("uint8", numbers.data(), numbers.size(), 1);
}

ArrayPlace ArrayBytes::add_rounded(const Eigen::VectorXd& values) {
  std::vector<float> numbers(static_cast<std::size_t>(values.size()));
  std::transform(values.begin(), values.end(), numbers.begin(), with_fewer_bits);
  return add(numbers);
}

}  // namespace ibmfair
