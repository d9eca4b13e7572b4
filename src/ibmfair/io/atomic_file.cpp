#include "ibmfair/io/atomic_file.h"

#include <cerrno>
#include <cstdio>
#include <filesystem>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/io/numbers.h"

namespace ibmfair {
namespace {

constexpr int most_links = 40;  // as the kernel allows
constexpr int most_names = 1000;

std::string directory_of(const std::string& path) {
  const std::string parent = std::filesystem::path(path).parent_path().string();
  return parent.empty() ? "." : parent;
}

/// Where a chain of symbolic links ends, whether or not anything is there.
std::string follow_links(const std::string& path) {
  std::filesystem::path target = path;
  std::error_code error;
  for (int i = 0; i < most_links && std::filesystem::is_symlink(target, error); ++i) {
    const std::filesystem::path next = std::filesystem::read_symlink(target, error);
    if (error) break;
    target = next.is_absolute() ? next : target.parent_path() / next;
  }
  return target.string();
}

/// Names of open descriptors: what stands behind them must be written, never replaced.
bool names_a_descriptor(const std::string& path) {
  return path == "/dev/stdout" || path == "/dev/stderr" || path.starts_with("/dev/fd/") ||
         path.starts_with("/proc/self/fd/");
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path, bool overwrite)
    : name_(path == "-"    ? "standard output"
            : path.empty() ? "''"
                           : path),
      overwrite_(overwrite) {
  buffer_ = std::make_unique_for_overwrite<char[]>(capacity);
  if (path == "-") {
    fd_ = STDOUT_FILENO;
    return;
  }
  if (path.empty()) fail(ENOENT);
  struct stat status {};
  const bool exists = stat(path.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) fail(EISDIR);
  if (exists && (!S_ISREG(status.st_mode) || names_a_descriptor(path))) {
    fd_ = open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (fd_ < 0) fail(errno);
    return;
  }
  if (exists && !overwrite) {
    throw CannotWrite(fmt::format("{}: exists already; --overwrite replaces it", name_));
  }
  std::error_code error;
  if (!exists && !overwrite && std::filesystem::is_symlink(path, error)) {
    throw CannotWrite(
        fmt::format("{}: a symbolic link to what is not there; --overwrite makes it", name_));
  }
  if (exists && access(path.c_str(), W_OK) != 0) fail(errno);
  target_ = follow_links(path);
  open_temporary();
  // Best effort: only root may give a file to its former owner.
  if (exists && fchown(fd_, status.st_uid, status.st_gid) != 0) errno = 0;
  if (exists && fchmod(fd_, status.st_mode & 07777) != 0) fail(errno);
}

AtomicFile::~AtomicFile() {
  if (fd_ > STDERR_FILENO) close(fd_);
  if (!temporary_.empty()) unlink(temporary_.c_str());
}

void AtomicFile::open_temporary() {
  const std::string directory = directory_of(target_);
  fd_ = open(directory.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
  if (fd_ >= 0) return;
  if (errno != EOPNOTSUPP && errno != EISDIR && errno != EINVAL) fail(errno);
  for (int i = 0; i < most_names && fd_ < 0; ++i) {
    temporary_ = fmt::format("{}/.ibmfair-{}-{}.tmp", directory, getpid(), i);
    fd_ = open(temporary_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (fd_ < 0 && errno != EEXIST) break;
  }
  if (fd_ < 0) {
    temporary_.clear();
    fail(errno);
  }
}

void AtomicFile::name_temporary() {
  const std::string self = fmt::format("/proc/self/fd/{}", fd_);
  for (int i = 0; i < most_names; ++i) {
    const std::string name =
        fmt::format("{}/.ibmfair-{}-{}.tmp", directory_of(target_), getpid(), i);
    if (linkat(AT_FDCWD, self.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0) {
      temporary_ = name;
      return;
    }
    if (errno != EEXIST) break;
  }
  fail(errno);
}

void AtomicFile::replace_target() {
  if (temporary_.empty()) name_temporary();
  if (!overwrite_) {
    // Somebody may have created the target since the constructor looked.
    if (renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), RENAME_NOREPLACE) == 0) {
      temporary_.clear();
      return;
    }
    if (errno != EINVAL && errno != ENOSYS) fail(errno);
  }
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  temporary_.clear();
}

void AtomicFile::write_real(double value) {
  char buffer[real_text_capacity];
  write(real_text(value, buffer));
}

void AtomicFile::write_through(std::string_view bytes) {
  flush();
  while (!bytes.empty()) {
    const ssize_t count = ::write(fd_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(errno);
    flushed_ += count;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

void AtomicFile::flush() {
  if (used_ == 0) return;
  const std::string_view pending(buffer_.get(), used_);
  used_ = 0;
  write_through(pending);
}

void AtomicFile::commit() {
  flush();
  if (target_.empty()) return;
  if (fsync(fd_) != 0) fail(errno);
  replace_target();
  // The rename itself reaches the disk with its directory; not every file system can be asked.
  const int directory = open(directory_of(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (directory >= 0) {
    fsync(directory);
    close(directory);
  }
}

void AtomicFile::fail(int error) const {
  throw CannotWrite(fmt::format("{}: cannot be written: {}", name_, std::strerror(error)));
}

void require_writable(const std::string& path, bool overwrite) {
  const AtomicFile probe(path, overwrite);
}

}  // namespace ibmfair
