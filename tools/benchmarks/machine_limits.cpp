#include "machine_limits.h"

#include <algorithm>
#include <cstdlib>
#include <new>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

#include <cblas.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace ibmfair::benchmarks {
namespace {

constexpr std::size_t value_count = std::size_t{1} << 25;  // 256 MB
constexpr std::size_t large_page = std::size_t{1} << 21;
constexpr int matrix_size = 1024;
constexpr std::size_t buffer_size = std::size_t{1} << 18;

/// A file that is open for the length of a scope.
class OpenFile {
 public:
  OpenFile(const std::string& path, int flags) : fd_(open(path.c_str(), flags | O_CLOEXEC, 0600)) {
    if (fd_ < 0) {
      throw std::runtime_error("cannot open " + path);
    }
  }
  ~OpenFile() { close(fd_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  int get() const { return fd_; }

 private:
  int fd_;
};

void multiply(const double* A, const double* B, double* C) {
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, matrix_size, matrix_size, matrix_size, 1,
              A, matrix_size, B, matrix_size, 1, C, matrix_size);
}

void multiply(const float* A, const float* B, float* C) {
  cblas_sgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, matrix_size, matrix_size, matrix_size, 1,
              A, matrix_size, B, matrix_size, 1, C, matrix_size);
}

}  // namespace

MemoryReading::MemoryReading()
    : values_(static_cast<std::uint64_t*>(
          std::aligned_alloc(large_page, value_count * sizeof(std::uint64_t)))) {
  if (values_ == nullptr) {
    throw std::bad_alloc();
  }
  // Asks for large pages: with small pages, the page tables would limit the speed.
  madvise(values_, value_count * sizeof(std::uint64_t), MADV_HUGEPAGE);
  std::fill_n(values_, value_count, std::uint64_t{1});
}

MemoryReading::~MemoryReading() {
  std::free(values_);
}

std::uint64_t MemoryReading::sum(int threads) const {
  // Integers, because the compiler may reorder, and so vectorise, their sum.
  std::vector<std::uint64_t> sums(static_cast<std::size_t>(threads));
  std::vector<std::jthread> readers;
  readers.reserve(sums.size());
  for (int t = 0; t < threads; ++t) {
    readers.emplace_back([&, t] {
      const std::uint64_t* first = values_ + value_count * t / threads;
      const std::uint64_t* last = values_ + value_count * (t + 1) / threads;
      sums[t] = std::accumulate(first, last, std::uint64_t{0});
    });
  }
  readers.clear();  // waits for the threads
  return std::accumulate(sums.begin(), sums.end(), std::uint64_t{0});
}

double MemoryReading::bytes() const {
  return static_cast<double>(value_count * sizeof(std::uint64_t));
}

template <class Real>
MatrixProduct<Real>::MatrixProduct()
    : A_(static_cast<std::size_t>(matrix_size) * matrix_size, Real{1}), B_(A_), C_(A_) {
  openblas_set_num_threads(1);
}

template <class Real>
void MatrixProduct<Real>::run() {
  multiply(A_.data(), B_.data(), C_.data());
}

template <class Real>
double MatrixProduct<Real>::flops() const {
  return 2.0 * matrix_size * matrix_size * matrix_size;
}

template class MatrixProduct<double>;
template class MatrixProduct<float>;

std::size_t read_bytes(const std::string& path) {
  const OpenFile file(path, O_RDONLY);
  std::vector<char> buffer(buffer_size);
  std::size_t total = 0;
  ssize_t count = 0;
  while ((count = read(file.get(), buffer.data(), buffer.size())) > 0) {
    total += static_cast<std::size_t>(count);
  }
  if (count < 0) {
    throw std::runtime_error("cannot read " + path);
  }
  return total;
}

void write_bytes(const std::string& path, std::size_t count) {
  {
    const OpenFile file(path, O_WRONLY | O_CREAT | O_TRUNC);
    const std::vector<char> buffer(buffer_size, 'x');
    while (count > 0) {
      const ssize_t written = write(file.get(), buffer.data(), std::min(count, buffer.size()));
      if (written <= 0) {
        throw std::runtime_error("cannot write " + path);
      }
      count -= static_cast<std::size_t>(written);
    }
    fsync(file.get());
  }
  unlink(path.c_str());
}

}  // namespace ibmfair::benchmarks
