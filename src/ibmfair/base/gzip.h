// Compresses and decompresses bytes in the gzip format, RFC 1952.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace ibmfair {

/// Receives output piece by piece.
using TakeBytes = std::function<void(std::string_view)>;

/// Compresses like `gzip -n`: without name and time, so that equal input gives equal output.
class GzipEncoder {
 public:
  /// Throws std::bad_alloc if memory runs out.
  GzipEncoder();
  ~GzipEncoder();
  GzipEncoder(const GzipEncoder&) = delete;
  GzipEncoder& operator=(const GzipEncoder&) = delete;

  /// Compresses `bytes`; after the `last` bytes the data is complete, and nothing may follow.
  void add(std::string_view bytes, bool last, const TakeBytes& take);

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
};

/// The output of GzipEncoder.
std::string gzip(std::string_view bytes);

/// Whether the bytes start like gzip data.
bool is_gzip(std::string_view bytes);

/// Decompresses gzip data of one or several members. Returns what is wrong with the data, or an
/// empty text if nothing is; zero bytes after the data are ignored. Throws what `take` throws, and
/// std::bad_alloc if memory runs out.
std::string gunzip(std::string_view bytes, const TakeBytes& take);

}  // namespace ibmfair
