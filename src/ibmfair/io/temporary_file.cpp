#include "ibmfair/io/temporary_file.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <unistd.h>

namespace ibmfair {
namespace {

/// The names in use. If there are more files than entries, the names of the others are not
/// recorded, and remove_temporary_files() leaves their files behind.
std::array<std::atomic<const char*>, 64> names_in_use{};
static_assert(std::atomic<const char*>::is_always_lock_free);

std::atomic<const char*>* note(const char* name) {
  for (auto& place : names_in_use) {
    const char* nothing = nullptr;
    if (place.compare_exchange_strong(nothing, name)) return &place;
  }
  return nullptr;
}

int rename_where_nothing_is(const char* from, const char* to) {
  if (renameat2(AT_FDCWD, from, AT_FDCWD, to, RENAME_NOREPLACE) == 0) return 0;
  if (errno != EINVAL && errno != ENOSYS) return errno;
  // Network file systems lack renameat2(); file systems of cameras have no hard links.
  if (link(from, to) == 0) {
    unlink(from);
    return 0;
  }
  if (errno == EEXIST) return EEXIST;
  return std::rename(from, to) == 0 ? 0 : errno;
}

}  // namespace

void remove_temporary_files() {
  for (auto& place : names_in_use) {
    if (const char* name = place.exchange(nullptr); name != nullptr) {
      unlink(name);
    }
  }
}

TemporaryFile::~TemporaryFile() {
  if (fd_ >= 0) close(fd_);
  if (!name_.empty()) {
    unlink(name_.c_str());
    forget_name();
  }
}

/// Chooses and records the name before the file exists, so that no signal can come in between. The
/// name is random, so that the file to remove is never one of another program.
void TemporaryFile::choose_name() {
  std::uint64_t number = 0;
  while (getrandom(&number, sizeof number, 0) < 0 && errno == EINTR) {
  }
  name_ = fmt::format("{}/.ibmfair-{}-{:016x}.tmp", directory_, getpid(), number);
  noted_ = note(name_.c_str());
}

void TemporaryFile::forget_name() {
  const char* name = name_.c_str();
  if (noted_ != nullptr && !noted_->compare_exchange_strong(name, nullptr)) {
    while (true)
      pause();  // another thread is ending the process and still uses the name
  }
  noted_ = nullptr;
  name_.clear();
}

int TemporaryFile::create(const std::string& directory, bool named) {
  directory_ = directory;
  // A file without a name is given one through /proc, which not every system has.
  if (!named && access("/proc/self/fd", X_OK) == 0) {
    fd_ = open(directory.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    if (fd_ >= 0) return 0;
    if (errno != EOPNOTSUPP && errno != EISDIR && errno != EINVAL) return errno;
  }
  choose_name();
  fd_ = open(name_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
  if (fd_ >= 0) return 0;
  const int error = errno;
  forget_name();
  return error;
}

int TemporaryFile::move_to(const std::string& target, bool overwrite) {
  if (name_.empty()) {
    const std::string self = fmt::format("/proc/self/fd/{}", fd_);
    if (overwrite) choose_name();
    const std::string& name = overwrite ? name_ : target;
    if (linkat(AT_FDCWD, self.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) != 0) {
      return errno;
    }
    if (!overwrite) return 0;
  }
  const int error = !overwrite ? rename_where_nothing_is(name_.c_str(), target.c_str())
                    : std::rename(name_.c_str(), target.c_str()) == 0 ? 0
                                                                      : errno;
  if (error == 0) forget_name();
  return error;
}

}  // namespace ibmfair
