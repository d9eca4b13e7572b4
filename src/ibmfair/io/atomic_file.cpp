#include "ibmfair/io/atomic_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "ibmfair/base/errors.h"

namespace ibmfair {
namespace {

constexpr int most_links = 40;  // the limit that the Linux kernel sets

std::string directory_of(const std::string& path) {
  const std::string parent = std::filesystem::path(path).parent_path().string();
  return parent.empty() ? "." : parent;
}

/// The path at the end of a chain of symbolic links, whether or not a file exists there.
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

/// Whether the path names an open descriptor. Its file must be written to and never replaced.
bool names_a_descriptor(const std::string& path) {
  return path == "/dev/stdout" || path == "/dev/stderr" || path.starts_with("/dev/fd/") ||
         path.starts_with("/proc/self/fd/");
}

/// Whether the path is a device, a pipe or a descriptor, none of which can be replaced.
bool is_written_directly(const std::string& path, const struct stat& status) {
  return !S_ISREG(status.st_mode) || names_a_descriptor(path);
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path, bool overwrite, Sharing sharing)
    : name_(path == "-"    ? "standard output"
            : path.empty() ? "''"
                           : path),
      overwrite_(overwrite) {
  if (path == "-") {
    fd_ = STDOUT_FILENO;
    return;
  }
  if (path.empty()) fail(ENOENT);
  struct stat status {};
  const bool exists = stat(path.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) fail(EISDIR);
  if (exists && is_written_directly(path, status)) {
    fd_ = open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (fd_ < 0) fail(errno);
    return;
  }
  if (exists && !overwrite) {
    throw CannotWrite(fmt::format("{}: exists already; --overwrite replaces it", name_));
  }
  std::error_code error;
  if (!exists && !overwrite && std::filesystem::is_symlink(path, error)) {
    throw CannotWrite(fmt::format(
        "{}: is a symbolic link to a file that does not exist; --overwrite creates that file",
        name_));
  }
  if (exists && access(path.c_str(), W_OK) != 0) fail(errno);
  target_ = follow_links(path);
  const bool named = sharing == Sharing::by_name;
  if (const int error = temporary_.create(directory_of(target_), named); error != 0) fail(error);
  fd_ = temporary_.descriptor();
  // Best effort: only root may set another owner.
  if (exists && fchown(fd_, status.st_uid, status.st_gid) != 0) errno = 0;
  if (exists && fchmod(fd_, status.st_mode & 07777) != 0) fail(errno);
}

AtomicFile::~AtomicFile() {
  if (target_.empty() && fd_ > STDERR_FILENO) close(fd_);
}

void AtomicFile::take(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(fd_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(errno);
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

void AtomicFile::commit() {
  flush();
  if (target_.empty()) return;
  if (fsync(fd_) != 0) fail(errno);
  if (const int error = temporary_.move_to(target_, overwrite_); error != 0) fail(error);
  // Flushing the directory makes the rename itself permanent; not every file system supports it.
  const int directory = open(directory_of(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (directory >= 0) {
    fsync(directory);
    close(directory);
  }
}

void AtomicFile::fail(int error) const {
  const std::string folder = directory_of(target_.empty() ? name_ : target_);
  const bool no_folder = error == ENOENT && access(folder.c_str(), F_OK) != 0;
  throw CannotWrite(fmt::format(
      "{}: cannot be written: {}", name_,
      no_folder ? fmt::format("there is no folder '{}'", folder) : std::strerror(error)));
}

void require_writable(const std::string& path, bool overwrite) {
  struct stat status {};
  if (stat(path.c_str(), &status) == 0 && is_written_directly(path, status) &&
      !S_ISDIR(status.st_mode)) {
    return;  // a reader of the pipe would take the end of this test for the end of the data
  }
  const AtomicFile probe(path, overwrite);
}

}  // namespace ibmfair
