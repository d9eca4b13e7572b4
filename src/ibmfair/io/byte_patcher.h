// Copies a file with some of its numbers replaced.
#pragma once

#include <string_view>

#include "ibmfair/io/byte_sink.h"
#include "ibmfair/io/source_bytes.h"

namespace ibmfair {

/// Replacements must come in the order of the file; everything between them is copied as it is.
class BytePatcher {
 public:
  BytePatcher(const SourceBytes& source, ByteSink& out)
      : copied_(source.begin()), end_(source.end()), out_(out) {}

  /// Puts the shortest text of `value` in the place of [first, last).
  void replace(const char* first, const char* last, double value) {
    remove(first, last);
    out_.write_real(value);
  }

  /// Puts `text` in the place of [first, last).
  void replace(const char* first, const char* last, std::string_view text) {
    remove(first, last);
    out_.write(text);
  }

  /// Leaves out [first, last).
  void remove(const char* first, const char* last) {
    copy_up_to(first);
    copied_ = last;
  }

  /// Copies what stands before `p`; what is written to the file next is inserted there.
  void copy_up_to(const char* p) {
    if (p > copied_) out_.write({copied_, static_cast<std::size_t>(p - copied_)});
    copied_ = p;
  }

  /// Copies what is left.
  void finish() { copy_up_to(end_); }

 private:
  const char* copied_;
  const char* end_;
  ByteSink& out_;
};

}  // namespace ibmfair
