// This library is loaded into the program by LD_PRELOAD. It makes chosen calls of the C library
// fail, or sends a signal instead, as tests/support/faults.h says. It counts calls from the
// program's `main` on.
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/syscall.h>
#include <unistd.h>

extern "C" {  // of glibc, behind the functions that are replaced here
// NOLINTBEGIN(bugprone-reserved-identifier)
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
// NOLINTEND(bugprone-reserved-identifier)
}

namespace {

struct Plan {
  const char* call = "";
  long first = 0, last = 0;
  int error = 0, signal_number = 0;
  bool no_unnamed_files = false;
  const char* truncated = nullptr;
};

Plan plan;
std::atomic<bool> active{false};
std::atomic<long> count{0};

long number_in_environment(const char* name) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::atol(text) : 0;
}

/// Counts a call and returns true if the call is to fail. Otherwise, if the fault says so, a signal
/// is sent or a file is cut off before the call, and the call then goes on.
bool fails(const char* call) {
  if (!active || std::strcmp(call, plan.call) != 0) {
    return false;
  }
  const long number = ++count;
  if (number < plan.first || number > plan.last) {
    return false;
  }
  if (plan.signal_number != 0) {
    kill(getpid(), plan.signal_number);
    return false;
  }
  if (plan.truncated != nullptr) {
    [[maybe_unused]] const int status = truncate(plan.truncated, 99);
    return false;
  }
  errno = plan.error;
  return true;
}

void write_count() {
  active = false;
  const char* path = std::getenv("FAULT_COUNT");
  if (std::FILE* file = path != nullptr ? std::fopen(path, "w") : nullptr; file != nullptr) {
    std::fprintf(file, "%ld\n", count.load());
    std::fclose(file);
  }
}

int open_file(const char* path, int flags, mode_t mode) {
  if (active && plan.no_unnamed_files && (flags & O_TMPFILE) == O_TMPFILE) {
    errno = EOPNOTSUPP;
    return -1;
  }
  return fails("open") ? -1 : static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}

}  // namespace

extern "C" {

using Main = int (*)(int, char**, char**);

// NOLINTNEXTLINE(bugprone-reserved-identifier)
int __libc_start_main(Main main, int argc, char** argv, void (*init)(), void (*end)(),
                      void (*end_of_loader)(), void* stack) {
  static Main real_main = main;
  const auto real =
      reinterpret_cast<decltype(&__libc_start_main)>(dlsym(RTLD_NEXT, "__libc_start_main"));
  if (const char* call = std::getenv("FAULT_CALL"); call != nullptr) {
    plan.call = call;
  }
  plan.first = number_in_environment("FAULT_FIRST");
  plan.last = number_in_environment("FAULT_LAST");
  plan.error = static_cast<int>(number_in_environment("FAULT_ERROR"));
  plan.signal_number = static_cast<int>(number_in_environment("FAULT_SIGNAL"));
  plan.truncated = std::getenv("FAULT_TRUNCATED");
  plan.no_unnamed_files = number_in_environment("FAULT_NO_UNNAMED_FILES") != 0;
  const Main counted = [](int words, char** word, char** environment) {
    active = true;
    const int code = real_main(words, word, environment);
    write_count();
    return code;
  };
  return real(counted, argc, argv, init, end, end_of_loader, stack);
}

// NOLINTNEXTLINE(bugprone-reserved-identifier)
void _Exit(int code) {
  write_count();
  while (true)
    syscall(SYS_exit_group, code);
}

void* malloc(std::size_t size) {
  return fails("malloc") ? nullptr : __libc_malloc(size);
}

void* calloc(std::size_t items, std::size_t size) {
  return fails("malloc") ? nullptr : __libc_calloc(items, size);
}

void* realloc(void* memory, std::size_t size) {
  return fails("malloc") ? nullptr : __libc_realloc(memory, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return fails("malloc") ? nullptr : __libc_memalign(alignment, size);
}

int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  *memory = fails("malloc") ? nullptr : __libc_memalign(alignment, size);
  return *memory != nullptr ? 0 : ENOMEM;
}

int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = va_arg(more, mode_t);
  va_end(more);
  return open_file(path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = va_arg(more, mode_t);
  va_end(more);
  return open_file(path, flags, mode);
}

ssize_t read(int fd, void* buffer, std::size_t size) {
  return fails("read") ? -1 : syscall(SYS_read, fd, buffer, size);
}

ssize_t write(int fd, const void* buffer, std::size_t size) {
  return fd > STDERR_FILENO && fails("write") ? -1 : syscall(SYS_write, fd, buffer, size);
}

int flock(int fd, int operation) noexcept {
  return fails("flock") ? -1 : static_cast<int>(syscall(SYS_flock, fd, operation));
}

int fsync(int fd) {
  return fails("fsync") ? -1 : static_cast<int>(syscall(SYS_fsync, fd));
}

int linkat(int from_directory, const char* from, int to_directory, const char* to,
           int flags) noexcept {
  return fails("linkat")
             ? -1
             : static_cast<int>(syscall(SYS_linkat, from_directory, from, to_directory, to, flags));
}

int renameat2(int from_directory, const char* from, int to_directory, const char* to,
              unsigned flags) noexcept {
  return fails("rename") ? -1
                         : static_cast<int>(syscall(SYS_renameat2, from_directory, from,
                                                    to_directory, to, flags));
}

int rename(const char* from, const char* to) noexcept {
  return fails("rename")
             ? -1
             : static_cast<int>(syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

int fchmod(int fd, mode_t mode) noexcept {
  return fails("fchmod") ? -1 : static_cast<int>(syscall(SYS_fchmod, fd, mode));
}

}  // extern "C"
