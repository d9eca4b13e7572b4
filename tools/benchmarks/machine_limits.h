// The limits of the machine: kernels with which every figure of the benchmark is compared.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace ibmfair::benchmarks {

/// An array far larger than any cache, to measure the speed of reading memory.
class MemoryReading {
 public:
  MemoryReading();
  ~MemoryReading();
  MemoryReading(const MemoryReading&) = delete;
  MemoryReading& operator=(const MemoryReading&) = delete;

  /// Sums the array on this number of threads.
  std::uint64_t sum(int threads) const;

  double bytes() const;

 private:
  std::uint64_t* values_;
};

/// C += A B for square matrices, by OpenBLAS on one thread.
template <class Real>
class MatrixProduct {
 public:
  MatrixProduct();
  void run();

  /// Of one run.
  double flops() const;

 private:
  std::vector<Real> A_, B_, C_;
};

extern template class MatrixProduct<double>;
extern template class MatrixProduct<float>;

/// Reads a file from its first byte to its last into one small buffer, as `cat` does; returns the
/// number of bytes. Throws std::runtime_error.
std::size_t read_bytes(const std::string& path);

/// Writes this number of bytes to a new file, flushes it to the disk and removes it.
/// Throws std::runtime_error.
void write_bytes(const std::string& path, std::size_t count);

}  // namespace ibmfair::benchmarks
