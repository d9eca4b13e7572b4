#include "commands/batch/temporaries.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <optional>

#include "ibmfair/io/numbers.h"

namespace ibmfair::commands {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view prefix = ".ibmfair-";
constexpr std::string_view suffix = ".tmp";

/// Parses the whole text as a positive number; nothing if it is not one.
std::optional<pid_t> number_in(std::string_view text) {
  std::int64_t value = 0;
  const char* end = text.data() + text.size();
  const bool whole = !text.empty() && parse_integer(text.data(), end, value) == end;
  return whole && value > 0 ? std::optional(static_cast<pid_t>(value)) : std::nullopt;
}

/// The process that made a temporary file with this name; nothing for names of other files.
std::optional<pid_t> maker_of(std::string_view name) {
  if (!name.starts_with(prefix) || !name.ends_with(suffix)) {
    return std::nullopt;
  }
  const std::string_view numbers =
      name.substr(prefix.size(), name.size() - prefix.size() - suffix.size());
  return number_in(numbers.substr(0, numbers.find('-')));
}

bool is_gone(pid_t process) {
  return kill(process, 0) != 0 && errno == ESRCH;
}

bool is_old(const fs::path& path) {
  std::error_code error;
  const auto time = fs::last_write_time(path, error);
  return !error && fs::file_time_type::clock::now() - time > std::chrono::hours(1);
}

int remove_where(const std::set<std::string>& folders,
                 const std::function<bool(const fs::path&, pid_t)>& unwanted) {
  int removed = 0;
  for (const std::string& folder : folders) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      const auto maker = maker_of(entry.path().filename().string());
      if (maker && unwanted(entry.path(), *maker) && fs::remove(entry.path(), error)) {
        ++removed;
      }
    }
  }
  return removed;
}

}  // namespace

void remove_temporaries_of(pid_t process, const std::set<std::string>& folders) {
  remove_where(folders, [&](const fs::path&, pid_t maker) { return maker == process; });
}

int remove_stale_temporaries(const std::set<std::string>& folders, bool others_work) {
  return remove_where(folders, [&](const fs::path& path, pid_t maker) {
    return is_gone(maker) && (!others_work || is_old(path));
  });
}

}  // namespace ibmfair::commands
