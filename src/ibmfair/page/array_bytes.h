// Arrays of numbers one after the other, as a page reads them back.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// Where an array stands.
struct ArrayPlace {
  std::string_view type;    ///< `float32`, `uint32` or `uint8`, little-endian
  std::int64_t offset = 0;  ///< bytes, a multiple of 4
  std::int64_t length = 0;  ///< numbers
};

class ArrayBytes {
 public:
  ArrayPlace add(std::span<const float> numbers);
  ArrayPlace add(std::span<const std::uint32_t> numbers);
  ArrayPlace add(std::span<const std::uint8_t> numbers);

  /// Values of a field, rounded to 12 bits: more than any colour shows, and half the bytes once
  /// they are compressed. What does not fit into a float becomes the largest one; NaN stays.
  ArrayPlace add_rounded(const Eigen::VectorXd& values);

  const std::string& bytes() const { return bytes_; }

 private:
  ArrayPlace append(std::string_view type, const void* data, std::size_t count, std::size_t size);

  std::string bytes_;
};

}  // namespace ibmfair
