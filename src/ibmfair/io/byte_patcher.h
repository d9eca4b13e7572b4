// Copies a file with some of its numbers replaced.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ibmfair/io/byte_sink.h"
#include "ibmfair/io/source_bytes.h"

namespace ibmfair {

/// Replacements must come in the order of the file; everything between them is copied as it is.
/// Finding the text of a number takes longer than all else: it is left until there are many of
/// them, for all threads.
class BytePatcher {
 public:
  BytePatcher(const SourceBytes& source, ByteSink& out)
      : copied_(source.begin()), end_(source.end()), out_(out) {}

  /// Puts the shortest text of `value` in the place of [first, last).
  void replace(const char* first, const char* last, double value) {
    put_off(first, last, value, false);
  }
  void replace(const char* first, const char* last, float value) {
    put_off(first, last, value, true);
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
  void copy_up_to(const char* p);

  /// Copies what is left.
  void finish() { copy_up_to(end_); }

 private:
  /// Bytes of the source, and the number behind them.
  struct Piece {
    std::string_view copied;
    double value;
    bool single;  // a float's
  };

  void put_off(const char* first, const char* last, double value, bool single);
  void write_pieces();
  static void join(std::span<const Piece> pieces, std::string& text);

  const char* copied_;  // up to here, by pieces, too
  const char* end_;
  ByteSink& out_;
  std::vector<Piece> pieces_;       // that are not written yet
  std::size_t piece_bytes_ = 0;     // copied by these
  std::vector<std::string> texts_;  // of some of them each, kept for their memory
};

}  // namespace ibmfair
