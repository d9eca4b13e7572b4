#include "assimp_helper/confinement.h"

#include <algorithm>
#include <csignal>
#include <initializer_list>

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace ibmfair {
namespace {

void lower_limit(__rlimit_resource resource, rlim_t soft, rlim_t hard) {
  struct rlimit limit {};
  getrlimit(resource, &limit);
  limit.rlim_max = std::min(limit.rlim_max, hard);
  limit.rlim_cur = std::min({limit.rlim_cur, limit.rlim_max, soft});
  setrlimit(resource, &limit);
}

// The definitions of linux/landlock.h; on many systems this header is older than the kernel.
struct RulesetAttributes {
  std::uint64_t file_rights;
  std::uint64_t network_rights;
  std::uint64_t scopes;
};

struct __attribute__((packed)) PathBeneath {
  std::uint64_t allowed;
  std::int32_t folder;
};

constexpr unsigned ask_for_version = 1;
constexpr int rule_path_beneath = 1;
constexpr std::uint64_t right_to_read_files = 1U << 2U;

constexpr std::uint64_t lowest_bits(int count) {
  return (std::uint64_t{1} << count) - 1;
}

/// All access rights that this version of Landlock can restrict.
RulesetAttributes all_rights(long version) {
  RulesetAttributes all{};
  all.file_rights = lowest_bits(version >= 5 ? 16 : version >= 3 ? 15 : version == 2 ? 14 : 13);
  all.network_rights = version >= 4 ? lowest_bits(2) : 0;
  all.scopes = version >= 6 ? lowest_bits(2) : 0;
  return all;
}

}  // namespace

void limit_resources(std::uint64_t cpu_seconds, [[maybe_unused]] std::uint64_t address_space) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  // The soft limit raises SIGXCPU, which identifies the cause; the hard limit raises SIGKILL, which
  // has many possible causes.
  lower_limit(RLIMIT_CPU, cpu_seconds, cpu_seconds + 1);
  for (const auto resource : {RLIMIT_FSIZE, RLIMIT_NPROC, RLIMIT_CORE}) {
    lower_limit(resource, 0, 0);
  }
#ifndef IBMFAIR_SANITIZED  // the sanitizers need the whole address space
  lower_limit(RLIMIT_AS, address_space, address_space);
#endif
}

void confine_to(int folder) {
  const long version = syscall(SYS_landlock_create_ruleset, nullptr, 0, ask_for_version);
  if (version < 1) return;
  const RulesetAttributes all = all_rights(version);
  const std::size_t size = version >= 6 ? sizeof all : version >= 4 ? 16 : 8;
  const int ruleset = static_cast<int>(syscall(SYS_landlock_create_ruleset, &all, size, 0));
  if (ruleset < 0) return;
  const PathBeneath rule{right_to_read_files, folder};
  if (folder >= 0) syscall(SYS_landlock_add_rule, ruleset, rule_path_beneath, &rule, 0);
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  syscall(SYS_landlock_restrict_self, ruleset, 0);
  close(ruleset);
}

}  // namespace ibmfair
