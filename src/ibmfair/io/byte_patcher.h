// Copies a file and replaces some of its numbers.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ibmfair/io/byte_sink.h"
#include "ibmfair/io/source_bytes.h"

namespace ibmfair {

/// Replacements must be given in the order of the file; everything between them is copied
/// unchanged. Most of the time goes into converting numbers to text, so numbers are collected until
/// there are many, and then converted on all threads.
class BytePatcher {
 public:
  BytePatcher(const SourceBytes& source, ByteSink& out)
      : copied_(source.begin()), end_(source.end()), out_(out) {}

  /// Replaces [first, last) by the shortest text that reads back as `value`.
  void replace(const char* first, const char* last, double value) {
    put_off(first, last, value, false);
  }
  void replace(const char* first, const char* last, float value) {
    put_off(first, last, value, true);
  }

  /// Replaces [first, last) by `text`.
  void replace(const char* first, const char* last, std::string_view text) {
    remove(first, last);
    out_.write(text);
  }

  /// Leaves out the bytes in [first, last).
  void remove(const char* first, const char* last) {
    copy_up_to(first);
    copied_ = last;
  }

  /// Copies the bytes before `p`. Bytes written to the output directly after this call are inserted
  /// there.
  void copy_up_to(const char* p);

  /// Copies the rest of the file.
  void finish() { copy_up_to(end_); }

 private:
  /// Bytes of the source, and the number to write after them.
  struct Piece {
    std::string_view copied;
    double value;
    bool single;  // the number is a float
  };

  void put_off(const char* first, const char* last, double value, bool single);
  void write_pieces();
  static void join(std::span<const Piece> pieces, std::string& text);

  const char* copied_;  // the source is copied up to here, if `pieces_` are included
  const char* end_;
  ByteSink& out_;
  std::vector<Piece> pieces_;    // pieces that are not written yet
  std::size_t piece_bytes_ = 0;  // source bytes in `pieces_`
  // The text of one group of pieces each; kept to reuse the memory.
  std::vector<std::string> texts_;
};

}  // namespace ibmfair
