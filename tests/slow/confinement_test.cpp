// The process that reads a foreign format is confined: the tests check the actions that it can no
// longer perform, whatever code takes it over.
#include "assimp_helper/confinement.h"

#include <csignal>
#include <cstdlib>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/files.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {
namespace {

/// The exit code of a check that runs in a process of its own; negative if a signal ended the
/// process.
template <class Check>
int exit_code_of(const Check& check) {
  const pid_t child = fork();
  if (child == 0) _exit(check());
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

bool opens(const std::string& path, int flags) {
  return open(path.c_str(), flags | O_CLOEXEC, 0600) >= 0;
}

TEST(Confinement, OpensNothingButFilesInTheFolder) {
  constexpr unsigned ask_for_version = 1;
  if (syscall(SYS_landlock_create_ruleset, nullptr, 0, ask_for_version) < 1) {
    GTEST_SKIP() << "this kernel has no Landlock";
  }
  const TemporaryDirectory folder, elsewhere;
  write_bytes(folder / "mine", "mine");
  write_bytes(elsewhere / "mine", "mine");
  const int descriptor = open(folder.path().c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
  EXPECT_EQ(exit_code_of([&] {
              confine_to(descriptor);
              if (!opens(folder / "mine", O_RDONLY)) return 1;
              if (opens(elsewhere / "mine", O_RDONLY)) return 2;
              if (opens("/etc/passwd", O_RDONLY)) return 3;
              if (opens(folder / "mine", O_RDWR)) return 4;
              if (opens(folder / "new", O_CREAT | O_WRONLY)) return 5;
              if (unlink((folder / "mine").c_str()) == 0) return 6;
              if (mkdir((folder / "new").c_str(), 0700) == 0) return 7;
              if (execl("/bin/true", "true", nullptr) == 0) return 8;
              return 0;
            }),
            0);
  EXPECT_EQ(exit_code_of([&] {
              confine_to(-1);
              return opens(folder / "mine", O_RDONLY) ? 1 : 0;
            }),
            0);
  close(descriptor);
  EXPECT_EQ(read_bytes(folder / "mine"), "mine");
}

TEST(Confinement, LimitsTimeAndMemoryAndWritesNothing) {
  const TemporaryDirectory folder;
  constexpr std::size_t gigabyte = std::size_t{1} << 30;
  EXPECT_EQ(exit_code_of([&] {
              limit_resources(1, gigabyte);
              volatile bool waiting = true;
              while (waiting) {
              }
              return 0;
            }),
            -SIGXCPU);
  EXPECT_EQ(exit_code_of([&] {
              limit_resources(10, gigabyte);
              const int file = open((folder / "new").c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0600);
              return write(file, "x", 1) == 1 ? 1 : 0;
            }),
            -SIGXFSZ);
#ifndef IBMFAIR_SANITIZED
  EXPECT_EQ(exit_code_of([&] {
              limit_resources(10, gigabyte);
              void* const memory = std::malloc(2 * gigabyte);
              return memory == nullptr ? 0 : 1;
            }),
            0);
#endif
}

TEST(Confinement, LeavesTighterLimitsAsTheyAre) {
  EXPECT_EQ(exit_code_of([] {
              const struct rlimit tight { 7, 8 };
              setrlimit(RLIMIT_CPU, &tight);
              limit_resources(100, std::size_t{1} << 30);
              struct rlimit found {};
              getrlimit(RLIMIT_CPU, &found);
              return found.rlim_cur == 7 && found.rlim_max == 8 ? 0 : 1;
            }),
            0);
}

}  // namespace
}  // namespace ibmfair::test
