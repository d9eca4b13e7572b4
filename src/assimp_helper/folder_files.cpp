#include "assimp_helper/folder_files.h"

#include <cerrno>
#include <filesystem>
#include <memory>
#include <string_view>

#include <assimp/MemoryIOWrapper.h>
#include <fcntl.h>
#include <linux/openat2.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace ibmfair {
namespace {

namespace fs = std::filesystem;

/// Importers put this prefix before the names of files that the main file refers to.
constexpr const char* folder_as_seen = "./";

std::string with_extension(const fs::path& path, const std::string& extension) {
  const std::string name = path.filename().string();
  const std::string end = "." + extension;
  return name.ends_with(end) ? name : name + end;
}

/// A descriptor that is closed when it goes out of scope.
struct OpenFile {
  int fd;
  explicit OpenFile(int fd) : fd(fd) {}
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile() {
    if (fd >= 0) close(fd);
  }
};

/// Reads the whole file; if the file shrinks meanwhile, the stream ends early.
Assimp::IOStream* read_into_stream(const OpenFile& file) {
  struct stat status {};
  fstat(file.fd, &status);
  const auto size = static_cast<std::size_t>(status.st_size);
  auto bytes = std::make_unique<std::uint8_t[]>(size);
  std::size_t done = 0;
  while (done < size) {
    const ssize_t count = read(file.fd, bytes.get() + done, size - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    done += static_cast<std::size_t>(count);
  }
  constexpr bool owned = true;
  return new Assimp::MemoryIOStream(bytes.release(), done, owned);
}

}  // namespace

FolderFiles::FolderFiles(const std::string& path, const std::string& extension,
                         std::span<const std::uint8_t> bytes)
    : main_name_(folder_as_seen + with_extension(path.empty() ? "input" : path, extension)),
      bytes_(bytes) {
  if (path.empty()) return;
  const std::string parent = fs::path(path).parent_path().string();
  folder_ = open(parent.empty() ? "." : parent.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
}

FolderFiles::~FolderFiles() {
  if (folder_ >= 0) close(folder_);
}

/// Opens a file of the folder; returns a negative number if the file does not exist or must not be
/// read. The kernel itself enforces that the name stays in the folder, so that no link can be
/// exchanged between a check and its use.
int FolderFiles::open_beneath(const char* name) const {
  struct open_how how {};
  how.flags = O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK;  // opening a pipe must not block
  how.resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS;
  const auto opened = syscall(SYS_openat2, folder_, name, &how, sizeof how);
  if (opened < 0) {
    if (errno == EXDEV && outside_.empty()) outside_ = name;
    return -1;
  }
  const int fd = static_cast<int>(opened);
  struct stat status {};
  if (fstat(fd, &status) == 0 && S_ISREG(status.st_mode)) return fd;
  close(fd);
  return -1;
}

bool FolderFiles::Exists(const char* name) const {
  if (name == main_name_) return true;
  return OpenFile(open_beneath(name)).fd >= 0;
}

Assimp::IOStream* FolderFiles::Open(const char* name, const char* mode) {
  if (std::string_view(mode).find_first_of("wa+") != std::string_view::npos) return nullptr;
  if (name == main_name_) return new Assimp::MemoryIOStream(bytes_.data(), bytes_.size());
  const OpenFile file(open_beneath(name));
  return file.fd < 0 ? nullptr : read_into_stream(file);
}

}  // namespace ibmfair
