// The program on a system with faults: each output of a run is complete or absent, inputs are never
// touched, temporary files do not stay behind, and the exit code says what happened.
#include "support/faults.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <unistd.h>

#include "support/files.h"
#include "support/run_program.h"
#include "support/temporary_directory.h"

namespace ibmfair {
namespace {

namespace fs = std::filesystem;
using test::contains;
using test::environment_of;
using test::Fault;
using test::read_bytes;
using test::run_program;
using test::RunOptions;
using test::RunResult;
using test::StandardOutput;
using test::TemporaryDirectory;
using test::Words;
using test::write_bytes;
using test::WritingRun;
using test::operator+;

constexpr int cannot_write = 6, bad_file = 3;

/// A folder with a small noisy sphere, `in.ply`.
class Faults : public testing::Test {
 protected:
  Faults() {
    EXPECT_EQ(run({"make", "icosphere", in_, "--noise", "0.1", "--subdivide", "3"}).exit_code, 0);
    bytes_ = read_bytes(in_);
    const RunResult smoothed = run(smooth("-"));
    EXPECT_EQ(smoothed.exit_code, 0) << smoothed.err;
    smoothed_ = smoothed.out;
  }

  static RunResult run(const Words& words, const RunOptions& options = {}) {
    return run_program(words, options);
  }

  Words smooth(const std::string& out, const Words& more = {}) const {
    return Words{"smooth", in_, out, "--steps", "2"} + more;
  }

  const TemporaryDirectory directory_;
  const std::string in_ = directory_ / "in.ply", out_ = directory_ / "out.ply";
  std::string bytes_, smoothed_;
};

/// A separate file system of this size, which exists while the process lives. Only root can make
/// such a file system.
class SmallDisk {
 public:
  SmallDisk(const std::string& folder, int kilobytes) : folder_(folder) {
    fs::create_directory(folder);
    const std::string size = "size=" + std::to_string(kilobytes) + "k";
    mounted_ = mount("tmpfs", folder.c_str(), "tmpfs", 0, size.c_str()) == 0;
  }
  ~SmallDisk() {
    if (mounted_) {
      umount2(folder_.c_str(), MNT_DETACH);
    }
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  bool mounted() const { return mounted_; }
  bool protect() const {
    return mount(nullptr, folder_.c_str(), nullptr, MS_REMOUNT | MS_RDONLY, nullptr) == 0;
  }

 private:
  std::string folder_;
  bool mounted_ = false;
};

TEST_F(Faults, ACallThatFailsLeavesTheOldFileOrTheNewOne) {
  if (!test::faults_can_be_injected()) {
    GTEST_SKIP() << "AddressSanitizer is in the way";
  }
  WritingRun smooth({"smooth", "in.ply", "out.ply", "--steps", "1", "--overwrite"}, {"out.ply"});
  for (const std::string call : {"open", "write", "fsync", "linkat", "rename", "fchmod"}) {
    const RunResult result = smooth.run({.environment = environment_of({call, 1, 1000})});
    EXPECT_EQ(result.exit_code, cannot_write) << call;
    smooth.expect_promises(result);
    EXPECT_EQ(smooth.count_temporary_files(), 0U) << call;
  }
  const RunResult unreadable = smooth.run({.environment = environment_of({"read", 1, 1000, EIO})});
  EXPECT_EQ(unreadable.exit_code, bad_file);
  smooth.expect_promises(unreadable);
}

TEST_F(Faults, OnAFullDiskTheOldFileStays) {
  const std::string folder = directory_ / "disk";
  const SmallDisk disk(folder, 16);
  if (!disk.mounted()) {
    GTEST_SKIP() << "only root can make a disk";
  }
  write_bytes(folder + "/out.ply", "old");
  for (const Words& words :
       {smooth(folder + "/out.ply", {"--overwrite"}), smooth(folder + "/new.ply"),
        Words{"make", "torus", folder + "/torus.off"}}) {
    const RunResult result = run(words);
    EXPECT_EQ(result.exit_code, cannot_write);
    EXPECT_TRUE(contains(result.err, "No space left")) << result.err;
  }
  EXPECT_EQ(read_bytes(folder + "/out.ply"), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
}

TEST_F(Faults, OnAProtectedDiskNothingIsTried) {
  const std::string folder = directory_ / "disk";
  const SmallDisk disk(folder, 1024);
  if (!disk.mounted()) {
    GTEST_SKIP() << "only root can make a disk";
  }
  write_bytes(folder + "/out.ply", "old");
  ASSERT_TRUE(disk.protect());
  for (const std::string name : {"/out.ply", "/new.ply"}) {
    const RunResult result = run(smooth(folder + name, {"--overwrite"}));
    EXPECT_EQ(result.exit_code, cannot_write);
    EXPECT_TRUE(contains(result.err, "Read-only")) << result.err;
  }
}

TEST_F(Faults, ProtectedFilesAndFoldersStayAsTheyAre) {
  if (geteuid() == 0) {
    GTEST_SKIP() << "nothing is protected from root";
  }
  const std::string folder = directory_ / "folder";
  fs::create_directory(folder);
  write_bytes(folder + "/out.ply", "old");
  fs::permissions(folder + "/out.ply", fs::perms::owner_read);
  EXPECT_EQ(run(smooth(folder + "/out.ply", {"--overwrite"})).exit_code, cannot_write);
  fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_EQ(run(smooth(folder + "/new.ply")).exit_code, cannot_write);
  fs::permissions(folder, fs::perms::owner_all);
  EXPECT_EQ(read_bytes(folder + "/out.ply"), "old");
  fs::permissions(in_, fs::perms::none);
  EXPECT_EQ(run(smooth(out_)).exit_code, bad_file);
}

TEST_F(Faults, ALimitOfFileSizesIsAnErrorNotTheEnd) {
  write_bytes(out_, "old");
  const RunResult result = run(smooth(out_, {"--overwrite"}), {.limits = {"--fsize=4096"}});
  EXPECT_EQ(result.exit_code, cannot_write);
  EXPECT_TRUE(contains(result.err, "File too large")) << result.err;
  EXPECT_EQ(read_bytes(out_), "old");
  EXPECT_EQ(directory_.entries(), 2U);
}

TEST_F(Faults, WhatIsDoneToTheTargetMeanwhileIsNotUndone) {
  // The run takes long enough that the target can be changed while it runs. A change before the
  // first look at the target is an error, too.
  const Words words{"smooth", in_, directory_ / "folder/out.ply", "--steps", "3000", "--overwrite"};
  const auto meanwhile = [&](const Words& run_words, const auto& act) {
    fs::remove_all(directory_ / "folder");
    fs::create_directory(directory_ / "folder");
    const auto start = std::chrono::steady_clock::now();
    bool done = false;
    return run(
        run_words, {.signal_when = [&] {
          if (!done && std::chrono::steady_clock::now() - start > std::chrono::milliseconds(60)) {
            done = true;
            act();
          }
          return false;
        }});
  };
  const RunResult gone = meanwhile(words, [&] { fs::remove_all(directory_ / "folder"); });
  EXPECT_EQ(gone.exit_code, cannot_write) << gone.err;
  EXPECT_FALSE(fs::exists(directory_ / "folder"));

  const std::string target = directory_ / "folder/out.ply";
  const RunResult folder = meanwhile(words, [&] { fs::create_directory(target); });
  EXPECT_EQ(folder.exit_code, cannot_write) << folder.err;
  EXPECT_TRUE(fs::is_directory(target));

  const Words careful(words.begin(), words.end() - 1);
  const RunResult taken = meanwhile(careful, [&] { write_bytes(target, "somebody else's"); });
  EXPECT_EQ(taken.exit_code, cannot_write) << taken.err;
  EXPECT_EQ(read_bytes(target), "somebody else's");
  EXPECT_EQ(std::distance(fs::directory_iterator(directory_ / "folder"), fs::directory_iterator()),
            1);
}

TEST_F(Faults, RunsWithoutAnyOfTheStandardStreams) {
  for (const std::vector<int>& closed :
       std::vector<std::vector<int>>{{0}, {1}, {2}, {0, 1}, {0, 2}, {1, 2}, {0, 1, 2}}) {
    const RunResult result = run(smooth(out_, {"--overwrite"}), {.closed = closed});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(read_bytes(out_), smoothed_);
    // Output that has nowhere to go is an error.
    EXPECT_EQ(run({"info", in_}, {.closed = closed}).exit_code,
              std::count(closed.begin(), closed.end(), 1) > 0 ? cannot_write : 0);
  }
  EXPECT_EQ(run({"info", "-"}, {.closed = {0}}).exit_code, bad_file);
}

TEST_F(Faults, TheOutputMayBeTheInputUnderAnyName) {
  const std::string hard = directory_ / "hard.ply", soft = directory_ / "soft.ply";
  fs::create_hard_link(in_, hard);
  fs::create_symlink("in.ply", soft);
  const std::string detour = directory_ / "../" + directory_.path().filename().string() + "/in.ply";
  for (const std::string& name : {in_, hard, soft, detour}) {
    EXPECT_EQ(run(smooth(name)).exit_code, cannot_write) << name;
    EXPECT_EQ(read_bytes(in_), bytes_);
  }
  // A hard link to the input becomes a file of its own.
  EXPECT_EQ(run(smooth(hard, {"--overwrite"})).exit_code, 0);
  EXPECT_EQ(read_bytes(hard), smoothed_);
  EXPECT_EQ(read_bytes(in_), bytes_);
  for (const std::string& name : {in_, soft, detour}) {
    EXPECT_EQ(run(smooth(name, {"--overwrite"})).exit_code, 0) << name;
    EXPECT_EQ(read_bytes(in_), smoothed_) << name;
    EXPECT_TRUE(fs::is_symlink(soft));
    write_bytes(in_, bytes_);
  }
}

TEST_F(Faults, OfTwoRunsToOneTargetBothAreWholeOrOneIsRefused) {
  const RunResult other = run(smooth("-", {"--cutoff", "20"}));
  for (int i = 0; i < 4; ++i) {
    const Words overwrite = i % 2 == 0 ? Words{} : Words{"--overwrite"};
    fs::remove(out_);
    RunResult first, second;
    std::thread beside([&] { first = run(smooth(out_, overwrite)); });
    second = run(smooth(out_, Words{"--cutoff", "20"} + overwrite));
    beside.join();
    const std::string bytes = read_bytes(out_);
    EXPECT_TRUE(bytes == smoothed_ || bytes == other.out);
    if (overwrite.empty()) {
      EXPECT_EQ(first.exit_code + second.exit_code, cannot_write) << first.err << second.err;
      EXPECT_EQ(bytes, first.exit_code == 0 ? smoothed_ : other.out);
    } else {
      EXPECT_EQ(first.exit_code + second.exit_code, 0) << first.err << second.err;
    }
    EXPECT_EQ(directory_.entries(), 2U);
  }
}

TEST_F(Faults, InputsThatAreNoFilesAreReadOrRefused) {
  const std::string pipe = directory_ / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::thread writer([&] { std::ofstream(pipe) << bytes_; });
  const RunResult piped = run({"smooth", pipe, "-", "--steps", "2", "--input-format", "ply"});
  writer.join();
  EXPECT_EQ(piped.exit_code, 0) << piped.err;
  EXPECT_EQ(piped.out, smoothed_);
  for (const std::string& name :
       {directory_.path().string(), directory_ / "missing.ply", in_ + "/in.ply",
        std::string("/dev/null"), std::string("/proc/self/mem")}) {
    const RunResult result = run({"info", name});
    EXPECT_EQ(result.exit_code, bad_file) << name;
    EXPECT_TRUE(contains(result.err, name)) << result.err;
  }
}

TEST_F(Faults, APipeAsOutputGetsTheWholeMeshOnce) {
  const std::string pipe = directory_ / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::string received;
  std::thread reader([&] { received = read_bytes(pipe); });
  const RunResult result = run(smooth(pipe, {"--format", "ply"}));
  reader.join();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(received, smoothed_);
}

TEST_F(Faults, AnInputThatChangesWhileItIsReadIsRefused) {
  if (!test::faults_can_be_injected()) {
    GTEST_SKIP() << "AddressSanitizer is in the way";
  }
  Fault fault{"read", 2, 2};  // the first call reads bytes, the second one reaches the end
  fault.truncated = in_;
  const RunResult result = run(smooth(out_), {.environment = environment_of(fault)});
  EXPECT_EQ(result.exit_code, bad_file) << result.err;
  EXPECT_TRUE(contains(result.err, "changed while it was being read")) << result.err;
  EXPECT_FALSE(fs::exists(out_));
}

TEST_F(Faults, AFormatThatCannotBeWrittenIsRefusedBeforeTheWork) {
  for (const std::string extension : {"vtk", "xyz", "step", "gltf", "new"}) {
    // So many steps would take a minute.
    const RunResult result =
        run({"smooth", in_, directory_ / ("out." + extension), "--steps", "1000000"});
    EXPECT_LE(result.cpu_seconds, 10);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_TRUE(contains(result.err, fmt::format("'{}' is not a mesh format that can be written; "
                                                 "name one with --format (one of: ply, off, obj, "
                                                 "stl)",
                                                 extension)))
        << result.err;
  }
}

TEST_F(Faults, AnInputOfMoreThanTheMemoryIsRefusedUnread) {
  fs::resize_file(in_, std::uintmax_t{1} << 42U);  // only the start takes space
  const RunResult sparse = run({"info", in_});
  EXPECT_EQ(sparse.exit_code, 5);
  EXPECT_TRUE(contains(sparse.err, "4398047 MB of memory")) << sparse.err;
#ifndef IBMFAIR_SANITIZED
  const RunResult endless = run({"info", "/dev/zero"}, {.address_space = std::int64_t{1} << 29U});
  EXPECT_EQ(endless.exit_code, 5);
  EXPECT_TRUE(contains(endless.err, "/dev/zero needs")) << endless.err;
#endif
}

}  // namespace
}  // namespace ibmfair
