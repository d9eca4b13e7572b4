// Sizes that are too large for the index type or for the memory are refused before any memory is
// taken.
#include <cstdint>
#include <filesystem>
#include <limits>
#include <new>
#include <span>
#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/mman.h>

#include "ibmfair/base/compressed_rows.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/base/process_memory.h"
#include "ibmfair/mesh/mesh.h"
#include "ibmfair/mesh/topology.h"
#include "support/files.h"
#include "support/run_program.h"
#include "support/solvers.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

TEST(Limits, ListsOfMoreEntriesThanCanBeNumberedAreRefused) {
  // The program must not look at the entries: this memory cannot be read.
  const std::size_t count = std::size_t{1} << 31U;
  void* const memory = mmap(nullptr, count * sizeof(Index), PROT_NONE,
                            MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory == MAP_FAILED) {
    GTEST_SKIP() << "no address space";
  }
  const std::span<const Index> values(static_cast<const Index*>(memory), count);
  EXPECT_THROW(positions_by_value(values, 1), BadMesh);
  munmap(memory, count * sizeof(Index));
}

TEST(Limits, MeshesOfMoreElementsThanCanBeNumberedAreRefused) {
#ifdef IBMFAIR_SANITIZED
  GTEST_SKIP() << "AddressSanitizer would fill the memory";
#endif
  try {
    const Points X(most_elements + 1, 3);  // never touched
    EXPECT_THROW(build_topology(X, Triangles(0, 3)), BadMesh);
    Triangles F(most_elements + 1, 3);
    EXPECT_THROW(build_topology(3, std::move(F)), BadMesh);
  } catch (const std::bad_alloc&) {
    GTEST_SKIP() << "no address space";
  }
}

/// A folder that stands for the root folder of a system.
class SystemFiles : public testing::Test {
 protected:
  void put(const std::string& name, const std::string& text) const {
    fs::create_directories(fs::path(root() + name).parent_path());
    write_bytes(root() + name, text);
  }
  std::string root() const { return directory_.path().string(); }
  double available() const { return available_bytes(root()); }

  const TemporaryDirectory directory_;
};

TEST_F(SystemFiles, SayWhatMemoryIsLeft) {
  EXPECT_EQ(available(), std::numeric_limits<double>::infinity());
  put("/proc/meminfo", "MemTotal: 999 kB\nMemAvailable:    500 kB\n");
  EXPECT_EQ(available(), 500 * 1024);
}

TEST_F(SystemFiles, SayWhatEveryControlGroupAroundLeaves) {
  put("/proc/self/cgroup", "0::/slice/job\n");
  put("/sys/fs/cgroup/slice/job/memory.max", "max\n");
  EXPECT_EQ(available(), std::numeric_limits<double>::infinity());
  put("/sys/fs/cgroup/slice/memory.max", "10000000\n");
  put("/sys/fs/cgroup/slice/memory.current", "4000000\n");
  EXPECT_EQ(available(), 6e6);
  put("/sys/fs/cgroup/slice/memory.stat", "anon 5\ninactive_file 1000000\n");
  EXPECT_EQ(available(), 7e6);
  put("/sys/fs/cgroup/slice/job/memory.max", "3000000\n");
  EXPECT_EQ(available(), 3e6);
  put("/sys/fs/cgroup/memory.max", "1000\n");  // as a container sees its own group
  EXPECT_EQ(available(), 1000);
  put("/sys/fs/cgroup/memory.current", "2000\n");
  EXPECT_EQ(available(), 0);
}

TEST_F(SystemFiles, SayTheSameForTheOlderKindOfGroups) {
  put("/proc/self/cgroup", "7:cpu:/\n4:hugetlb,memory:/job:1\n0::/\nnonsense\n");
  put("/sys/fs/cgroup/memory/job:1/memory.limit_in_bytes", "8000000\n");
  put("/sys/fs/cgroup/memory/job:1/memory.usage_in_bytes", "3000000\n");
  put("/sys/fs/cgroup/memory/job:1/memory.stat", "total_inactive_file 500000\n");
  EXPECT_EQ(available(), 5.5e6);
}

TEST(Limits, WhatDoesNotFitIntoTheAddressSpaceIsRefusedWithWhatWould) {
#ifdef IBMFAIR_SANITIZED
  GTEST_SKIP() << "AddressSanitizer needs all of the address space";
#endif
  const TemporaryDirectory directory;
  const std::string in = directory / "in.ply", out = directory / "out.ply";
  ASSERT_EQ(run_program({"make", "torus", in, "--rows", "240", "--columns", "600"}).exit_code, 0);
  const Words smooth{"smooth", in, out, "--quiet", "--threads", "1"};
  for (const std::string limit : {"--as=470000000", "--data=380000000"}) {
    SCOPED_TRACE(limit);
    const RunOptions limited{.limits = {limit}};
    for (const std::string& solver : solvers()) {
      if (solver == "cg") continue;
      const RunResult refused = run_program(smooth + Words{"--solver", solver}, limited);
      EXPECT_EQ(refused.exit_code, 5);
      EXPECT_TRUE(contains(refused.err, "the limit is") &&
                  contains(refused.err, "--solver cg fits"))
          << refused.err;
    }
    const RunResult chosen =
        run_program(smooth + Words{"--cutoff", "40", "--dry-run", "--json"}, limited);
    ASSERT_EQ(chosen.exit_code, 0) << chosen.err;
    EXPECT_EQ(json::parse(chosen.out)["forecast"]["solver"], "cg");
    EXPECT_FALSE(fs::exists(out));
  }
}

TEST(Limits, MemoryComesInLargePagesWhereTheSystemHasThem) {
  if (runs_in_emulator()) GTEST_SKIP() << "the emulator asks for memory in its own way";
#ifdef IBMFAIR_SANITIZED
  GTEST_SKIP() << "AddressSanitizer has a heap of its own";
#endif
  const std::string setting = "/sys/kernel/mm/transparent_hugepage/enabled";
  if (!fs::exists(setting) || contains(read_bytes(setting), "[never]")) {
    GTEST_SKIP() << "no large pages";
  }
  const TemporaryDirectory directory;
  const std::string in = directory / "in.ply", out = directory / "out.ply";
  ASSERT_EQ(run_program({"make", "torus", in, "--rows", "240", "--columns", "600"}).exit_code, 0);
  const RunResult run = run_program({"smooth", in, out, "--quiet", "--solver", "cg"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const double small_pages = run.peak_megabytes * 256;  // the number of pages if all had 4 KiB
  EXPECT_LT(static_cast<double>(run.page_faults), small_pages / 8);
}

TEST(Limits, FillKeepsToTheMemoryItIsGiven) {
  const TemporaryDirectory directory;
  const std::string in = directory / "in.off", out = directory / "out.off";
  ASSERT_EQ(run_program({"make", "cylinder", in, "--rows", "6"}).exit_code, 0);
  const RunResult refused = run_program({"fill", in, out, "--all", "--memory", "1M"});
  EXPECT_EQ(refused.exit_code, 5);
  EXPECT_TRUE(contains(refused.err, "the limit is 1 MB") &&
              contains(refused.err, "--max-new-vertices"))
      << refused.err;
  EXPECT_FALSE(fs::exists(out));
  EXPECT_EQ(run_program({"fill", in, out, "--all", "--memory", "4G"}).exit_code, 0);
}

}  // namespace
}  // namespace ibmfair::test
