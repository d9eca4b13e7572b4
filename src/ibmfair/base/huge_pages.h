// Memory for large buffers, in pages of 2 MiB.
#pragma once

#include <cstddef>
#include <memory>
#include <new>

namespace ibmfair {

/// Asks the kernel to back a buffer of many megabytes, not yet touched, with pages of 2 MiB.
/// Filling the buffer then causes five hundred times fewer page faults, which otherwise take a
/// third of the time of reading a file. This is advice only: nothing depends on whether the kernel
/// follows it.
void advise_huge_pages(void* start, std::size_t bytes);

/// An uninitialised array of plain numbers in large pages. The array starts at the start of a cache
/// line, so that each of a sequence of short vectors lies within one cache line.
template <class T>
class LargeArray {
 public:
  LargeArray() = default;
  explicit LargeArray(std::size_t size)
      : data_(static_cast<T*>(::operator new(size * sizeof(T), cache_line))), size_(size) {
    advise_huge_pages(data_.get(), size * sizeof(T));
  }

  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  std::size_t size() const { return size_; }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }

 private:
  static constexpr std::align_val_t cache_line{64};
  struct Delete {
    void operator()(T* data) const { ::operator delete(data, cache_line); }
  };

  std::unique_ptr<T[], Delete> data_;
  std::size_t size_ = 0;
};

}  // namespace ibmfair
