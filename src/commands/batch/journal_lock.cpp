#include "commands/batch/journal_lock.h"

#include <array>
#include <cerrno>
#include <climits>
#include <cstdint>
#include <ctime>
#include <fstream>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

namespace ibmfair::commands {

namespace {

using nlohmann::ordered_json;

std::string host_name() {
  std::array<char, HOST_NAME_MAX + 1> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

/// `process 4711 on node3, since 2026-11-28 04:28:11 UTC`, or nothing if the line is not that of a
/// run.
std::string name_of_run(const std::string& line) {
  const ordered_json run = ordered_json::parse(line, nullptr, false);
  if (!run.is_object() || run.value("event", "") != "run") {
    return {};
  }
  return fmt::format("process {} on {}, since {:%F %T} UTC", run.at("process").get<std::int64_t>(),
                     run.at("host").get<std::string>(),
                     fmt::gmtime(run.at("time").get<std::time_t>()));
}

std::string name_of_last_run(const std::string& path) {
  std::string name = "its process is not known";
  std::ifstream file(path, std::ios::binary);
  for (std::string line; std::getline(file, line);) {
    try {
      if (std::string found = name_of_run(line); !found.empty()) {
        name = std::move(found);
      }
    } catch (const ordered_json::exception&) {
      continue;  // a line of another version
    } catch (const fmt::format_error&) {
      continue;  // a time that is none
    }
  }
  return name;
}

}  // namespace

JournalLock lock_journal(int fd) {
  while (flock(fd, LOCK_EX | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK) {
      return JournalLock::held_by_another;
    }
    if (errno != EINTR) {
      return JournalLock::not_supported;
    }
  }
  return JournalLock::held;
}

std::string line_of_this_run() {
  return ordered_json{
      {"event", "run"}, {"host", host_name()}, {"process", getpid()}, {"time", std::time(nullptr)}}
      .dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

std::string message_about_other_run(const std::string& path) {
  return fmt::format(
      "{}: another run is recording in this file ({}); wait until it has ended, or end it and run "
      "the rest with --resume; if it runs other files, --journal FILE keeps a record of its own",
      path, name_of_last_run(path));
}

}  // namespace ibmfair::commands
