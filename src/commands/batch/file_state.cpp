#include "commands/batch/file_state.h"

#include <ctime>
#include <fstream>
#include <memory>

#include <fmt/format.h>
#include <sys/stat.h>

namespace ibmfair::commands {

namespace {

class Fnv1a {
 public:
  void add(std::string_view bytes) {
    for (const char byte : bytes) {
      hash_ = (hash_ ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
    }
  }
  std::string digits() const { return fmt::format("{:016x}", hash_); }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325U;
};

std::int64_t nanoseconds(const timespec& time) {
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

}  // namespace

std::optional<FileStamp> stamp_of(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) {
    return std::nullopt;
  }
  return FileStamp{status.st_size, nanoseconds(status.st_mtim), nanoseconds(status.st_ctim)};
}

std::string hash_of_text(std::string_view text) {
  Fnv1a hash;
  hash.add(text);
  return hash.digits();
}

std::optional<std::string> hash_of_file(const std::string& path) {
  constexpr std::size_t block = std::size_t{1} << 18;
  std::ifstream file(path, std::ios::binary);
  const auto buffer = std::make_unique<char[]>(block);
  Fnv1a hash;
  while (file) {
    file.read(buffer.get(), block);
    hash.add({buffer.get(), static_cast<std::size_t>(file.gcount())});
  }
  return file.eof() ? std::optional(hash.digits()) : std::nullopt;
}

}  // namespace ibmfair::commands
