// Conversion of numbers to and from bytes in either byte order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "ibmfair/io/byte_sink.h"

namespace ibmfair {

/// The T stored at `p`, with its bytes in reverse order if `swapped`.
template <class T>
T load(const char* p, bool swapped) {
  char bytes[sizeof(T)];
  for (std::size_t i = 0; i < sizeof(T); ++i)
    bytes[i] = p[swapped ? sizeof(T) - 1 - i : i];
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

/// The integer of type T stored at `p`, as 64 bits, for a count or an index.
template <class T>
std::int64_t load_integer(const char* p, bool swapped) {
  return static_cast<std::int64_t>(load<T>(p, swapped));
}

/// The bytes of `value`, in reverse order if `swapped`. The result points into `buffer`.
template <class T, std::size_t size>
std::string_view bytes_of(T value, bool swapped, char (&buffer)[size]) {
  static_assert(sizeof(T) <= size);
  std::memcpy(buffer, &value, sizeof(T));
  if (swapped) std::reverse(buffer, buffer + sizeof(T));
  return {buffer, sizeof(T)};
}

/// Writes the bytes of `value`, in reverse order if `swapped`.
template <class T>
void store(ByteSink& out, T value, bool swapped) {
  char buffer[sizeof(T)];
  out.write(bytes_of(value, swapped, buffer));
}

}  // namespace ibmfair
