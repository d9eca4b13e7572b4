#include "ibmfair/io/source_bytes.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <span>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/gzip.h"
#include "ibmfair/base/huge_pages.h"
#include "ibmfair/base/process_memory.h"
#include "ibmfair/base/short_text.h"

namespace ibmfair {
namespace {

constexpr std::size_t longest_quote = 40;

/// A file descriptor that is closed at the end of the scope, unless it is standard input.
struct Descriptor {
  int fd;
  explicit Descriptor(int fd) : fd(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd > STDIN_FILENO) close(fd);
  }
};

[[noreturn]] void fail_to_read(const std::string& name, int error) {
  throw BadFile(fmt::format("{}: cannot be read: {}", name, std::strerror(error)));
}

struct stat status_of(int fd, const std::string& name) {
  struct stat status {};
  if (fstat(fd, &status) != 0) fail_to_read(name, errno);
  if (S_ISDIR(status.st_mode)) fail_to_read(name, EISDIR);
  return status;
}

/// Whether the size of the file is known. It is not for pipes and for files that the kernel
/// generates.
bool has_size(const struct stat& status) {
  return S_ISREG(status.st_mode) && status.st_size > 0;
}

/// The initial capacity: the size of the file, one byte to detect its end without growing the
/// buffer, and one byte for the line feed at the end.
std::size_t first_capacity(const struct stat& status) {
  return has_size(status) ? static_cast<std::size_t>(status.st_size) + 2 : std::size_t{1} << 16;
}

/// Throws BadFile if the file has changed: the first part of one version and the last part of
/// another may well form a valid mesh.
void require_unchanged(const struct stat& before, int fd, const std::string& name) {
  const struct stat after = status_of(fd, name);
  if (has_size(before) &&
      (before.st_size != after.st_size || before.st_mtim.tv_sec != after.st_mtim.tv_sec ||
       before.st_mtim.tv_nsec != after.st_mtim.tv_nsec)) {
    throw BadFile(name + ": changed while it was being read");
  }
}

/// Bytes in memory, with room for more and for the line feed at the end.
class GrowingBuffer {
 public:
  /// Throws OutOfMemory with `name`, the name of the file, if there is not enough memory.
  GrowingBuffer(const std::string& name, std::size_t capacity) : name_(name), capacity_(capacity) {
    bytes_ = allocated();
  }

  std::string_view view() const { return {bytes_.get(), size_}; }

  /// At least one free byte.
  std::span<char> room() {
    if (size_ + 1 >= capacity_) {
      capacity_ *= 2;
      auto larger = allocated();
      std::copy_n(bytes_.get(), size_, larger.get());
      bytes_ = std::move(larger);
    }
    return {bytes_.get() + size_, capacity_ - size_ - 1};
  }

  /// Keeps the first bytes of room().
  void grow(std::size_t count) { size_ += count; }

  /// The bytes, followed by a line feed.
  std::unique_ptr<char[]> release() {
    bytes_[size_] = '\n';
    return std::move(bytes_);
  }

 private:
  std::unique_ptr<char[]> allocated() const {
    require_available(static_cast<double>(capacity_), name_);
    auto bytes = std::make_unique_for_overwrite<char[]>(capacity_);
    advise_huge_pages(bytes.get(), capacity_);
    return bytes;
  }

  std::string name_;
  std::size_t capacity_;
  std::unique_ptr<char[]> bytes_;
  std::size_t size_ = 0;
};

/// Throws BadFile if the gzip data is damaged.
GrowingBuffer decompressed(std::string_view zipped, const std::string& name) {
  constexpr std::size_t usual_ratio = 4;
  GrowingBuffer buffer(name, usual_ratio * zipped.size());
  const std::string problem = gunzip(zipped, [&](std::string_view piece) {
    while (!piece.empty()) {
      const std::span<char> room = buffer.room();
      const std::string_view next = piece.substr(0, room.size());
      std::copy(next.begin(), next.end(), room.begin());
      buffer.grow(next.size());
      piece.remove_prefix(next.size());
    }
  });
  if (!problem.empty()) throw BadFile(fmt::format("{}: {}", name, problem));
  return buffer;
}

}  // namespace

std::shared_ptr<const SourceBytes> SourceBytes::read(const std::string& path) {
  std::shared_ptr<SourceBytes> source(new SourceBytes);
  const bool standard_input = path == "-";
  source->name_ = standard_input ? "standard input" : path.empty() ? "''" : path;
  if (!standard_input) source->path_ = path;

  const Descriptor file(standard_input ? STDIN_FILENO : open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.fd < 0) fail_to_read(source->name_, errno);
  const struct stat status = status_of(file.fd, source->name_);
  GrowingBuffer buffer(source->name_, first_capacity(status));
  while (true) {
    const std::span<char> room = buffer.room();
    const ssize_t count = ::read(file.fd, room.data(), room.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail_to_read(source->name_, errno);
    if (count == 0) break;
    buffer.grow(static_cast<std::size_t>(count));
  }
  require_unchanged(status, file.fd, source->name_);
  if (is_gzip(buffer.view())) buffer = decompressed(buffer.view(), source->name_);
  source->size_ = buffer.view().size();
  source->bytes_ = buffer.release();
  return source;
}

std::shared_ptr<const SourceBytes> SourceBytes::from_memory(std::string name,
                                                            std::string_view bytes) {
  return from_memory(std::move(name), bytes.size(),
                     [bytes](char* place) { std::copy(bytes.begin(), bytes.end(), place); });
}

std::shared_ptr<const SourceBytes> SourceBytes::from_memory(
    std::string name, std::size_t size, const std::function<void(char*)>& fill) {
  std::shared_ptr<SourceBytes> source(new SourceBytes);
  source->name_ = std::move(name);
  source->bytes_ = std::make_unique_for_overwrite<char[]>(size + 1);
  fill(source->bytes_.get());
  source->bytes_[size] = '\n';
  source->size_ = size;
  return source;
}

TextPlace text_place(const SourceBytes& source, const char* where) {
  TextPlace place;
  const char* line_start = source.begin();
  for (const char* p = source.begin(); p != where; ++p) {
    const bool ends = *p == '\n' || (*p == '\r' && (p + 1 == source.end() || p[1] != '\n'));
    if (ends) {
      ++place.line;
      line_start = p + 1;
    }
  }
  place.column = where - line_start + 1;
  return place;
}

std::string word_at(const SourceBytes& source, const char* where) {
  const std::string_view rest(where, static_cast<std::size_t>(source.end() - where));
  return short_text(rest.substr(0, rest.find_first_of(" \t\n\v\f\r")), longest_quote);
}

void fail_in_text(const SourceBytes& source, const char* where, std::string_view message) {
  const TextPlace place = text_place(source, where);
  const std::string text = word_at(source, where);
  const std::string found = !text.empty()           ? fmt::format(" in '{}'", text)
                            : where == source.end() ? " at the end of the file"
                                                    : " at the end of the line";
  throw BadFile(fmt::format("{}:{}:{}: {}{}", source.name(), place.line, place.column,
                            short_text(message), found));
}

void fail_in_binary(const SourceBytes& source, std::string_view element, std::int64_t row,
                    const char* where, std::string_view message) {
  throw BadFile(fmt::format("{}: {} {} (byte {}): {}", source.name(),
                            short_text(element, longest_quote), row, where - source.begin(),
                            short_text(message)));
}

void fail_in_file(const SourceBytes& source, std::string_view message) {
  throw BadFile(fmt::format("{}: {}", source.name(), short_text(message)));
}

}  // namespace ibmfair
