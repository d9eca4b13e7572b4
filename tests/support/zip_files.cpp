#include "support/zip_files.h"

#include <cstdint>

#include <zlib.h>

namespace ibmfair::test {
namespace {

void append(std::string& bytes, std::uint64_t value, int size) {
  for (int i = 0; i < size; ++i) {
    bytes += static_cast<char>(value >> (8 * i) & 0xFFU);
  }
}

std::string deflated(const std::string& text) {
  z_stream stream{};
  deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, -MAX_WBITS, 9, Z_DEFAULT_STRATEGY);
  std::string result(deflateBound(&stream, text.size()), '\0');
  std::string input = text;
  stream.next_in = reinterpret_cast<Bytef*>(input.data());
  stream.avail_in = static_cast<uInt>(input.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  deflate(&stream, Z_FINISH);
  result.resize(stream.total_out);
  deflateEnd(&stream);
  return result;
}

}  // namespace

std::string zip_of(const std::vector<std::pair<std::string, std::string>>& entries, bool deflate,
                   bool zip64) {
  constexpr std::uint64_t in_extra = 0xFFFFFFFFU;
  std::string bytes, directory;
  for (const auto& [name, text] : entries) {
    const std::string data = deflate ? deflated(text) : text;
    const auto sum =
        crc32(0, reinterpret_cast<const Bytef*>(text.data()), static_cast<uInt>(text.size()));
    const std::uint64_t offset = bytes.size();
    std::string common;
    append(common, 20, 2);  // version
    append(common, 0, 2);   // flags
    append(common, deflate ? 8 : 0, 2);
    append(common, 0, 4);  // time
    append(common, sum, 4);
    append(common, zip64 ? in_extra : data.size(), 4);
    append(common, zip64 ? in_extra : text.size(), 4);
    append(common, name.size(), 2);
    bytes.append("PK\3\4").append(common).append(2, '\0').append(name).append(data);
    std::string extra;
    if (zip64) {
      append(extra, 1, 2);
      append(extra, 24, 2);
      for (const std::uint64_t value :
           {std::uint64_t{text.size()}, std::uint64_t{data.size()}, offset})
        append(extra, value, 8);
    }
    directory += "PK\1\2" + std::string(2, '\0') + common;
    append(directory, extra.size(), 2);
    directory += std::string(10, '\0');  // comment, disk, attributes
    append(directory, zip64 ? in_extra : offset, 4);
    directory += name + extra;
  }
  const std::uint64_t start = bytes.size();
  bytes += directory;
  if (zip64) {
    const std::uint64_t end64 = bytes.size();
    bytes += "PK\6\6";
    append(bytes, 44, 8);
    bytes += std::string(12, '\0');
    append(bytes, entries.size(), 8);
    append(bytes, entries.size(), 8);
    append(bytes, directory.size(), 8);
    append(bytes, start, 8);
    bytes += "PK\6\7" + std::string(4, '\0');
    append(bytes, end64, 8);
    append(bytes, 1, 4);
  }
  bytes += "PK\5\6" + std::string(4, '\0');
  append(bytes, zip64 ? 0xFFFF : entries.size(), 2);
  append(bytes, zip64 ? 0xFFFF : entries.size(), 2);
  append(bytes, zip64 ? in_extra : directory.size(), 4);
  append(bytes, zip64 ? in_extra : start, 4);
  return bytes + std::string(2, '\0');
}

}  // namespace ibmfair::test
