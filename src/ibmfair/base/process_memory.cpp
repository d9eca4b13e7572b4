#include "ibmfair/base/process_memory.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/huge_pages.h"

namespace ibmfair {
namespace {

constexpr double few_bytes = 64e6;

/// The number that follows `name` in a file with lines such as `VmRSS:   1234 kB`.
std::optional<double> entry(const std::string& path, const std::string& name) {
  std::ifstream file(path);
  for (std::string word; file >> word;) {
    if (double number = 0; word == name && file >> number) {
      return number;
    }
  }
  return std::nullopt;
}

constexpr double kilobyte = 1024;

/// The number in a file that holds nothing else; none if the file says "max".
std::optional<double> number_in(const std::string& path) {
  std::ifstream file(path);
  double number = 0;
  return file >> number ? std::optional(number) : std::nullopt;
}

/// The bytes that a control group and the groups that contain it still allow; `folder` is where the
/// system shows the groups. Inactive file pages count as used memory, but the kernel gives them
/// back when needed.
double left_in_groups(const std::string& folder, std::string group, const char* limit,
                      const char* usage, const char* inactive) {
  double left = std::numeric_limits<double>::infinity();
  while (true) {
    const std::string path = folder + group + "/";
    if (const auto most = number_in(path + limit)) {
      const double taken = number_in(path + usage).value_or(0);
      const double given_back = entry(path + "memory.stat", inactive).value_or(0);
      left = std::min(left, std::max(0.0, *most - std::max(0.0, taken - given_back)));
    }
    if (group.empty()) {
      return left;
    }
    group.resize(group.find_last_of('/'));
  }
}

/// Reads the process's control groups, of version 1 and 2, from lines `NUMBER:CONTROLLERS:/GROUP`.
double left_in_control_groups(const std::string& root) {
  double left = std::numeric_limits<double>::infinity();
  std::ifstream file(root + "/proc/self/cgroup");
  for (std::string line; std::getline(file, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos || second + 1 >= line.size() || line[second + 1] != '/') {
      continue;
    }
    std::string group = line.substr(second + 1);
    if (group == "/") {
      group.clear();
    }
    const std::string controllers =
        fmt::format(",{},", std::string_view(line).substr(first + 1, second - first - 1));
    const std::string folder = root + "/sys/fs/cgroup";
    if (controllers == ",,") {
      left = std::min(
          left, left_in_groups(folder, group, "memory.max", "memory.current", "inactive_file"));
    } else if (controllers.find(",memory,") != std::string::npos) {
      left = std::min(left, left_in_groups(folder + "/memory", group, "memory.limit_in_bytes",
                                           "memory.usage_in_bytes", "total_inactive_file"));
    }
  }
  return left;
}

/// A limit on the memory that the process may map, and the name under which the system shows how
/// much of it is in use.
struct MappingLimit {
  decltype(RLIMIT_AS) resource;
  const char* taken;

  double bytes() const {
    rlimit limit{};
    const bool limited = getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
    return limited ? static_cast<double>(limit.rlim_cur) : std::numeric_limits<double>::infinity();
  }
};

constexpr MappingLimit mapping_limits[] = {{RLIMIT_AS, "VmSize:"}, {RLIMIT_DATA, "VmData:"}};

double left_of_address_space(const std::string& root) {
  double left = std::numeric_limits<double>::infinity();
  for (const MappingLimit& limit : mapping_limits) {
    if (const double bytes = limit.bytes(); std::isfinite(bytes)) {
      const double taken = kilobyte * entry(root + "/proc/self/status", limit.taken).value_or(0);
      left = std::min(left, std::max(0.0, bytes - taken));
    }
  }
  return left;
}

}  // namespace

void keep_freed_memory() {
#ifdef __GLIBC__
  // An array in a mapping of its own would be returned to the system when it is freed.
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);  // never return memory at the end of the heap to the system
  mallopt(M_ARENA_MAX, 1);        // the heaps of other threads are mappings, too
#endif
}

void use_large_pages() {
#if defined(__GLIBC__) && !defined(IBMFAIR_SANITIZED)
  // In this mode, address space counts as used memory even if it is never touched.
  constexpr double all_is_counted = 2;
  if (std::isfinite(address_space_limit()) ||
      number_in("/proc/sys/vm/overcommit_memory") == all_is_counted) {
    return;
  }
  const auto bytes = static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) / 2 *
                     static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  if (void* const ahead = std::malloc(bytes)) {
    advise_huge_pages(ahead, bytes);
    std::free(ahead);  // the heap now reuses this memory
  }
#endif
}

double resident_bytes() {
  return kilobyte * entry("/proc/self/status", "VmRSS:").value_or(0);
}

double peak_resident_bytes() {
  return kilobyte * entry("/proc/self/status", "VmHWM:").value_or(0);
}

double available_bytes(const std::string& root) {
  const auto system = entry(root + "/proc/meminfo", "MemAvailable:");
  return std::min({system ? kilobyte * *system : std::numeric_limits<double>::infinity(),
                   left_in_control_groups(root), left_of_address_space(root)});
}

double address_space_limit() {
  double least = std::numeric_limits<double>::infinity();
  for (const MappingLimit& limit : mapping_limits) {
    least = std::min(least, limit.bytes());
  }
  return least;
}

bool is_available(double bytes) {
  return bytes < few_bytes || bytes <= available_bytes();
}

void require_available(double bytes, const std::string& what) {
  if (!is_available(bytes)) {
    constexpr double mega = 1e6;
    throw OutOfMemory(fmt::format("{} needs {:.0f} MB of memory, {:.0f} MB are available", what,
                                  bytes / mega, available_bytes() / mega));
  }
}

}  // namespace ibmfair
