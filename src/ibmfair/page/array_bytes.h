// Arrays of numbers, stored one after another in the form in which a web page reads them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// The location of an array in the bytes.
struct ArrayPlace {
  std::string_view type;    ///< `float32`, `uint32` or `uint8`, little-endian
  std::int64_t offset = 0;  ///< bytes, a multiple of 4
  std::int64_t length = 0;  ///< number of elements
};

class ArrayBytes {
 public:
  ArrayPlace add(std::span<const float> numbers);
  ArrayPlace add(std::span<const std::uint32_t> numbers);
  ArrayPlace add(std::span<const std::uint8_t> numbers);

  /// Adds the values of a field, with mantissas rounded to 12 bits. This precision exceeds that of
  /// any colour scale and halves the size of the compressed bytes. Values beyond half the largest
  /// float32 are clamped to it; NaN stays NaN.
  ArrayPlace add_rounded(const Eigen::VectorXd& values);

  const std::string& bytes() const { return bytes_; }

 private:
  ArrayPlace append(std::string_view type, const void* data, std::size_t count, std::size_t size);

  std::string bytes_;
};

}  // namespace ibmfair
