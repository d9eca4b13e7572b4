#include "commands/batch/claim_chain.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <optional>

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include "commands/batch/file_state.h"
#include "commands/batch/this_machine.h"
#include "ibmfair/base/errors.h"

namespace ibmfair::commands {

namespace {

using nlohmann::ordered_json;

/// Number of bytes that are read of a claim; enough for the start of the claim, which is unique.
constexpr std::size_t most_bytes = 4096;

/// A longer chain is an error, because it is unlikely that so many processes die with one item.
constexpr std::size_t longest_chain = 1000;

/// Parses the lines of a claim: the first describes the holder; the second, if it has been written,
/// names the process that runs the item.
void read_lines(const std::string& text, FoundClaim& claim) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const ordered_json holder = ordered_json::parse(text.substr(0, end), nullptr, false);
  const ordered_json runner = ordered_json::parse(text.substr(end), nullptr, false);
  const auto number = [](const ordered_json& json, const char* name) {
    return json.is_object() && json.contains(name) && json[name].is_number_integer()
               ? json[name].get<pid_t>()
               : 0;
  };
  if (holder.is_object() && holder.contains("processes_of") &&
      holder["processes_of"] == process_space() && !process_space().empty()) {
    claim.holder_here = number(holder, "pid");
  }
  claim.process = number(runner, "process");
}

/// Returns nothing if there is no claim at `path`. The file is opened because network file systems
/// ask their server only on open(), not on stat().
std::optional<FoundClaim> read_claim(const std::string& path) {
  const int fd = open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0 && (errno == ENOENT || errno == ESTALE)) {
    return std::nullopt;
  }
  struct stat status {};
  std::array<char, most_bytes> buffer{};
  const bool regular = fd >= 0 && fstat(fd, &status) == 0 && S_ISREG(status.st_mode);
  const ssize_t count = regular ? read(fd, buffer.data(), buffer.size()) : -1;
  const int error = fd >= 0 && !regular ? EINVAL : errno;
  if (fd >= 0) {
    close(fd);
  }
  if (count < 0) {
    if (error == ESTALE) {
      return std::nullopt;
    }
    cannot_claim_at(path, error);
  }
  const std::string text(buffer.data(), static_cast<std::size_t>(count));
  FoundClaim claim{path, mark_of(text), nanoseconds(status.st_mtim)};
  read_lines(text, claim);
  return claim;
}

}  // namespace

void cannot_claim_at(const std::string& path, int error) {
  throw CannotWrite(
      fmt::format("{}: cannot be used to claim items: {}", path, std::strerror(error)));
}

std::string mark_at(const std::string& path) {
  const std::optional<FoundClaim> claim = read_claim(path);
  return claim ? claim->mark : std::string();
}

std::string mark_of(const std::string& text) {
  return hash_of_text(text.substr(0, std::min(text.find('\n'), most_bytes)));
}

std::string name_of_claim(const ClaimFolder& folder, const std::string& key,
                          const std::string& predecessor_mark) {
  return fmt::format("{}/{}{}{}.claim", folder.path, hash_of_text(key),
                     predecessor_mark.empty() ? "" : "-", predecessor_mark);
}

std::vector<FoundClaim> find_chain(const ClaimFolder& folder, const std::string& key) {
  std::vector<FoundClaim> chain;
  std::string mark;
  while (auto claim = read_claim(name_of_claim(folder, key, mark))) {
    mark = claim->mark;
    chain.push_back(std::move(*claim));
    if (chain.size() > longest_chain) {
      cannot_claim_at(chain.back().path, ELOOP);
    }
  }
  return chain;
}

bool holder_is_gone(const FoundClaim& claim) {
  return claim.holder_here > 0 && kill(claim.holder_here, 0) != 0 && errno == ESRCH;
}

}  // namespace ibmfair::commands
