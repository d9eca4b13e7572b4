#include "ibmfair/base/gzip.h"

#include <algorithm>
#include <array>
#include <new>

#include <zlib.h>

namespace ibmfair {
namespace {

constexpr int with_gzip_header = 16;
constexpr std::size_t most_at_once = std::size_t{1} << 30U;  // zlib counts in 32 bits
using Buffer = std::array<Bytef, 1U << 16U>;

/// Lets zlib read the start of `bytes`, and removes it from them.
void feed(z_stream& stream, std::string_view& bytes) {
  const std::string_view next = bytes.substr(0, most_at_once);
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): zlib does not write there
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(next.data()));
  stream.avail_in = static_cast<uInt>(next.size());
  bytes.remove_prefix(next.size());
}

void prepare(z_stream& stream, Buffer& buffer) {
  stream.next_out = buffer.data();
  stream.avail_out = static_cast<uInt>(buffer.size());
}

std::string_view filled(const z_stream& stream, const Buffer& buffer) {
  return {reinterpret_cast<const char*>(buffer.data()), buffer.size() - stream.avail_out};
}

class Inflater {
 public:
  Inflater() {
    if (inflateInit2(&stream_, MAX_WBITS + with_gzip_header) != Z_OK) {
      throw std::bad_alloc();
    }
  }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  /// Decompresses one member at the start of `bytes`, and removes it from them. Returns whether the
  /// member is complete and undamaged.
  bool read_member(std::string_view& bytes, const TakeBytes& take) {
    inflateReset(&stream_);
    int code = Z_OK;
    while (code == Z_OK) {
      if (stream_.avail_in == 0) {
        feed(stream_, bytes);
      }
      prepare(stream_, buffer_);
      code = inflate(&stream_, Z_NO_FLUSH);
      take(filled(stream_, buffer_));
      if (code == Z_MEM_ERROR) {
        throw std::bad_alloc();
      }
    }
    const std::size_t unread = stream_.avail_in;
    bytes = {bytes.data() - unread, bytes.size() + unread};
    stream_.avail_in = 0;
    return code == Z_STREAM_END;
  }

 private:
  z_stream stream_{};
  Buffer buffer_;
};

}  // namespace

struct GzipEncoder::Stream {
  z_stream z{};
  Buffer buffer;
};

GzipEncoder::GzipEncoder() : stream_(std::make_unique<Stream>()) {
  constexpr int memory_level = 8;
  if (deflateInit2(&stream_->z, Z_DEFAULT_COMPRESSION, Z_DEFLATED, MAX_WBITS + with_gzip_header,
                   memory_level, Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::bad_alloc();
  }
}

GzipEncoder::~GzipEncoder() {
  deflateEnd(&stream_->z);
}

void GzipEncoder::add(std::string_view bytes, bool last, const TakeBytes& take) {
  z_stream& z = stream_->z;
  do {
    feed(z, bytes);
    do {
      prepare(z, stream_->buffer);
      deflate(&z, last && bytes.empty() ? Z_FINISH : Z_NO_FLUSH);
      take(filled(z, stream_->buffer));
    } while (z.avail_out == 0);
  } while (!bytes.empty());
}

std::string gzip(std::string_view bytes) {
  std::string out;
  GzipEncoder().add(bytes, true, [&](std::string_view piece) { out += piece; });
  return out;
}

bool is_gzip(std::string_view bytes) {
  return bytes.starts_with("\x1f\x8b");
}

std::string gunzip(std::string_view bytes, const TakeBytes& take) {
  Inflater inflater;
  while (is_gzip(bytes)) {
    if (!inflater.read_member(bytes, take)) {
      return "its gzip data is damaged or incomplete";
    }
  }
  const bool padded = std::all_of(bytes.begin(), bytes.end(), [](char c) { return c == 0; });
  return padded ? "" : "there is other data after its gzip data";
}

}  // namespace ibmfair
