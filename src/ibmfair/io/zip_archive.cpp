#include "ibmfair/io/zip_archive.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <limits>
#include <new>

#include <fmt/format.h>
#include <zlib.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/process_memory.h"
#include "ibmfair/base/short_text.h"
#include "ibmfair/io/binary_bytes.h"

namespace ibmfair {
namespace {

constexpr std::string_view end_mark("PK\5\6", 4), end64_mark("PK\6\6", 4),
    locator_mark("PK\6\7", 4), entry_mark("PK\1\2", 4), local_mark("PK\3\4", 4);
constexpr std::uint64_t end_size = 22, locator_size = 20, entry_size = 46, local_size = 30;
constexpr std::uint64_t longest_comment = 65535;
constexpr std::size_t longest_name = 100;  // in messages
constexpr std::uint32_t in_extra_field = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint16_t zip64_field = 1;
constexpr std::uint16_t encrypted = 1;  // a flag
constexpr std::uint16_t is_stored = 0, is_deflated = 8;
constexpr std::uint64_t best_ratio = 1032;                   // of deflate
constexpr std::size_t most_at_once = std::size_t{1} << 30U;  // zlib counts in 32 bits

[[noreturn]] void fail_as_truncated(const SourceBytes& source) {
  fail_in_file(source, "the zip archive is truncated or damaged");
}

std::string_view without_slash(std::string_view name) {
  return name.starts_with('/') ? name.substr(1) : name;
}

bool same_name(std::string_view a, std::string_view b) {
  return std::ranges::equal(
      a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

/// Decompresses into `result`, which has the announced size. Returns whether the data is complete.
bool inflate_all(std::string_view from, std::string& result) {
  z_stream stream{};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) throw std::bad_alloc();
  std::size_t done = 0;
  int code = Z_OK;
  while (code == Z_OK) {
    const std::size_t in = std::min(from.size(), most_at_once);
    const std::size_t room = std::min(result.size() - done, most_at_once);
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): zlib does not write there
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(from.data()));
    stream.avail_in = static_cast<uInt>(in);
    stream.next_out = reinterpret_cast<Bytef*>(result.data() + done);
    stream.avail_out = static_cast<uInt>(room);
    code = inflate(&stream, Z_NO_FLUSH);
    from.remove_prefix(in - stream.avail_in);
    done += room - stream.avail_out;
    if (stream.avail_in == in && stream.avail_out == room) break;  // no progress
  }
  inflateEnd(&stream);
  return code == Z_STREAM_END && done == result.size();
}

std::uint32_t checksum_of(std::string_view bytes) {
  uLong sum = crc32(0, nullptr, 0);
  while (!bytes.empty()) {
    const std::string_view next = bytes.substr(0, most_at_once);
    sum = crc32(sum, reinterpret_cast<const Bytef*>(next.data()), static_cast<uInt>(next.size()));
    bytes.remove_prefix(next.size());
  }
  return static_cast<std::uint32_t>(sum);
}

}  // namespace

ZipArchive::ZipArchive(const SourceBytes& source) : source_(source) {
  if (!source.view().starts_with(local_mark)) {
    fail_in_file(source, source.size() == 0 ? "the file is empty" : "not a zip archive");
  }
  read_directory();
}

/// The bytes [offset, offset + size); throws if the archive is shorter.
std::string_view ZipArchive::piece(std::uint64_t offset, std::uint64_t size) const {
  const std::uint64_t all = source_.size();
  if (offset > all || size > all - offset) fail_as_truncated(source_);
  return source_.view().substr(offset, size);
}

template <class T>
T ZipArchive::number(std::uint64_t offset) const {
  constexpr bool swapped = std::endian::native != std::endian::little;
  return load<T>(piece(offset, sizeof(T)).data(), swapped);
}

void ZipArchive::read_directory() {
  const std::string_view bytes = source_.view();
  const std::uint64_t searched = std::min<std::uint64_t>(bytes.size(), end_size + longest_comment);
  const std::size_t found = bytes.substr(bytes.size() - searched).rfind(end_mark);
  if (found == std::string_view::npos) fail_as_truncated(source_);
  const std::uint64_t end = bytes.size() - searched + found;
  std::uint64_t count = number<std::uint16_t>(end + 10);
  std::uint64_t offset = number<std::uint32_t>(end + 16);
  if (end >= locator_size && piece(end - locator_size, 4) == locator_mark) {
    const auto end64 = number<std::uint64_t>(end - locator_size + 8);
    if (piece(end64, 4) != end64_mark) fail_as_truncated(source_);
    count = number<std::uint64_t>(end64 + 32);
    offset = number<std::uint64_t>(end64 + 48);
  }
  if (count > bytes.size() / entry_size) fail_as_truncated(source_);
  for (std::uint64_t i = 0; i < count; ++i) {
    entries_.push_back(entry_at(offset));
  }
}

/// The entry of the directory at the offset, which moves behind the entry.
ZipArchive::Entry ZipArchive::entry_at(std::uint64_t& offset) const {
  if (piece(offset, 4) != entry_mark) fail_as_truncated(source_);
  Entry entry;
  entry.flags = number<std::uint16_t>(offset + 8);
  entry.method = number<std::uint16_t>(offset + 10);
  entry.checksum = number<std::uint32_t>(offset + 16);
  entry.compressed = number<std::uint32_t>(offset + 20);
  entry.size = number<std::uint32_t>(offset + 24);
  entry.header = number<std::uint32_t>(offset + 42);
  const auto name_size = number<std::uint16_t>(offset + 28);
  const auto extra_size = number<std::uint16_t>(offset + 30);
  const auto comment_size = number<std::uint16_t>(offset + 32);
  entry.name = piece(offset + entry_size, name_size);
  std::uint64_t extra = offset + entry_size + name_size;
  offset = extra + extra_size + comment_size;
  for (const std::uint64_t end = extra + extra_size; extra + 4 <= end;) {
    const auto field = number<std::uint16_t>(extra), size = number<std::uint16_t>(extra + 2);
    std::uint64_t at = extra + 4;
    extra = at + size;
    if (field != zip64_field) continue;
    for (std::uint64_t* value : {&entry.size, &entry.compressed, &entry.header}) {
      if (*value != in_extra_field) continue;
      if (at + 8 > extra) fail_as_truncated(source_);
      *value = number<std::uint64_t>(at);
      at += 8;
    }
  }
  return entry;
}

const ZipArchive::Entry* ZipArchive::find(std::string_view name) const {
  const auto entry = std::ranges::find_if(entries_, [&](const Entry& other) {
    return same_name(without_slash(other.name), without_slash(name));
  });
  return entry == entries_.end() ? nullptr : &*entry;
}

/// The bytes of the entry as they are stored in the archive.
std::string_view ZipArchive::stored(const Entry& entry, const std::string& title) const {
  if ((entry.flags & encrypted) != 0) throw BadFile(title + ": the entry is encrypted");
  if (entry.method != is_stored && entry.method != is_deflated) {
    throw BadFile(fmt::format("{}: the entry is compressed by method {}; only deflate is supported",
                              title, entry.method));
  }
  if (piece(entry.header, 4) != local_mark) fail_as_truncated(source_);
  const std::uint64_t name_and_extra = std::uint64_t{number<std::uint16_t>(entry.header + 26)} +
                                       number<std::uint16_t>(entry.header + 28);
  return piece(entry.header + local_size + name_and_extra, entry.compressed);
}

std::shared_ptr<const SourceBytes> ZipArchive::read(std::string_view name) const {
  const Entry* entry = find(name);
  const std::string title =
      fmt::format("{}: {}", source_.name(), short_text(without_slash(name), longest_name));
  if (entry == nullptr) throw BadFile(title + ": the zip archive has no such entry");
  const std::string_view bytes = stored(*entry, title);
  if (entry->method == is_stored) {
    if (checksum_of(bytes) != entry->checksum) throw BadFile(title + ": the entry is damaged");
    return SourceBytes::from_memory(title, bytes);
  }
  if (entry->size / best_ratio > entry->compressed) throw BadFile(title + ": the entry is damaged");
  require_available(2 * static_cast<double>(entry->size), title);
  std::string result(entry->size, '\0');
  if (!inflate_all(bytes, result) || checksum_of(result) != entry->checksum) {
    throw BadFile(title + ": the entry is damaged");
  }
  return SourceBytes::from_memory(title, result);
}

}  // namespace ibmfair
