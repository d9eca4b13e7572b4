// Output in the gzip format.
#pragma once

#include "ibmfair/base/gzip.h"
#include "ibmfair/io/byte_sink.h"

namespace ibmfair {

/// Compresses what is written, and writes it to another sink.
class GzipSink final : public ByteSink {
 public:
  /// `target` must outlive this object.
  explicit GzipSink(ByteSink& target) : target_(target) {}

  /// Completes the data. Nothing may be written afterwards.
  void finish() {
    flush();
    encoder_.add({}, true, [this](std::string_view piece) { target_.write(piece); });
  }

 private:
  void take(std::string_view bytes) override {
    encoder_.add(bytes, false, [this](std::string_view piece) { target_.write(piece); });
  }

  ByteSink& target_;
  GzipEncoder encoder_;
};

}  // namespace ibmfair
