#include "commands/batch/journal.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "commands/batch/journal_lock.h"
#include "commands/batch/json_text.h"
#include "commands/exit_code.h"
#include "ibmfair/base/errors.h"

namespace ibmfair::commands {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* shard_mark = "-of-";

std::string journal_line(const ordered_json& json) {
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

/// The time at which a line was written; 0 for lines of earlier versions, which do not contain it.
double time_of(const ordered_json& json) {
  return json.contains("time") ? json["time"].get<double>() : 0;
}

ordered_json stamp_json(const FileStamp& stamp) {
  return {stamp.size, stamp.mtime, stamp.ctime};
}

FileStamp stamp_from(const ordered_json& json) {
  return {json.at(0).get<std::int64_t>(), json.at(1).get<std::int64_t>(),
          json.at(2).get<std::int64_t>()};
}

double seconds_since_1970() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

/// A line about the end of the item with this key, with the current time.
std::string end_line(const char* event, const std::string& key, const Finished& finished) {
  ordered_json inputs = ordered_json::array();
  for (const Finished::Input& input : finished.inputs) {
    inputs.push_back({{"stamp", stamp_json(input.stamp)}, {"hash", input.hash}});
  }
  ordered_json outputs = ordered_json::array();
  for (const FileStamp& output : finished.outputs) {
    outputs.push_back(stamp_json(output));
  }
  const Outcome& outcome = finished.outcome;
  return journal_line({{"event", event},
                       {"key", key},
                       {"time", seconds_since_1970()},
                       {"program", finished.program},
                       {"options", finished.options},
                       {"inputs", inputs},
                       {"outputs", outputs},
                       {"exit_code", outcome.exit_code},
                       {"seconds", outcome.seconds},
                       {"peak_megabytes", outcome.peak_megabytes},
                       {"message", outcome.message},
                       {"figures", outcome.figures}});
}

/// Whether the file begins like a journal, or is a shorter prefix of this beginning.
bool starts_as_journal(int fd) {
  constexpr std::string_view start = R"({"event":")";
  std::array<char, start.size()> found{};
  const ssize_t count = pread(fd, found.data(), found.size(), 0);
  return count <= 0 || start.starts_with({found.data(), static_cast<std::size_t>(count)});
}

Finished finished_from(const ordered_json& json) {
  Finished finished;
  finished.program = json.at("program").get<std::string>();
  finished.options = json.at("options").get<std::string>();
  for (const ordered_json& input : json.at("inputs")) {
    finished.inputs.push_back({stamp_from(input.at("stamp")), input.at("hash").get<std::string>()});
  }
  for (const ordered_json& output : json.at("outputs")) {
    finished.outputs.push_back(stamp_from(output));
  }
  finished.outcome.exit_code = json.at("exit_code").get<int>();
  const bool done = finished.outcome.exit_code == static_cast<int>(ExitCode::done);
  finished.outcome.status = done ? Status::ok : Status::failed;
  finished.outcome.seconds = json.at("seconds").get<double>();
  finished.outcome.peak_megabytes = json.at("peak_megabytes").get<double>();
  finished.outcome.message = json.at("message").get<std::string>();
  finished.outcome.figures = json.at("figures");
  finished.time = time_of(json);
  return finished;
}

}  // namespace

Journal::Journal(const std::string& path) : path_(path) {
  fd_ = open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (fd_ < 0) {
    throw CannotWrite(fmt::format(
        "{}: cannot be written: {}", path,
        errno == ELOOP ? "a journal is not kept behind a symbolic link" : std::strerror(errno)));
  }
  const JournalLock lock = lock_journal(fd_);
  locked_ = lock == JournalLock::held;
  if (lock == JournalLock::held_by_another) {
    close(fd_);
    throw BadOption(message_about_other_run(path));
  }
  if (!starts_as_journal(fd_)) {
    close(fd_);
    throw CannotWrite(
        fmt::format("{}: exists already and is not the journal of a batch; --journal FILE names "
                    "another",
                    path));
  }
  char last = '\n';
  const off_t size = lseek(fd_, 0, SEEK_END);
  if (size > 0 && pread(fd_, &last, 1, size - 1) == 1 && last != '\n') {
    append("");  // ends the incomplete line that a killed run left
  }
  append(line_of_this_run());
}

Journal::~Journal() {
  close(fd_);
}

void Journal::fail() const {
  throw CannotWrite(fmt::format("{}: cannot be written: {}", path_, std::strerror(errno)));
}

void Journal::append(const std::string& line) {
  const std::string text = line + "\n";
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t count = write(fd_, text.data() + done, text.size() - done);
    if (count < 0 && errno != EINTR) {
      fail();
    }
    done += count > 0 ? static_cast<std::size_t>(count) : 0;
  }
  if (fsync(fd_) != 0 && errno != EINVAL) {  // EINVAL: a device, which has no fsync
    fail();
  }
}

void Journal::add_start(const std::string& key) {
  append(journal_line({{"event", "start"}, {"key", key}}));
}

void Journal::add_end(const std::string& key, const Finished& finished) {
  append(end_line("end", key, finished));
}

void Journal::add_refusal(const std::string& key, const Finished& finished) {
  append(end_line("refused", key, finished));
}

JournalRecord::JournalRecord(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    std::ifstream file(path, std::ios::binary);
    std::string line;
    while (std::getline(file, line) && !file.eof()) {
      try {
        read_line(line, path);
      } catch (const ordered_json::exception&) {
        continue;  // the start of a run, or a line of another version
      } catch (const BadFile&) {
        continue;  // an incomplete line
      }
    }
  }
}

void JournalRecord::read_line(const std::string& line, const std::string& path) {
  const ordered_json json = parse_json_text(line, "journal");
  const auto key = json.at("key").get<std::string>();
  if (json.at("event") == "start") {
    started_[key].insert(path);
    if (const auto last = last_.find(key); last != last_.end() && last->second.journal == path) {
      last_.erase(last);
    }
    return;
  }
  const Finished finished = finished_from(json);
  const auto [last, is_first] = last_.try_emplace(key, LastEnd{path, finished});
  if (!is_first && last->second.finished.time <= finished.time) {
    last->second = {path, finished};
  }
  if (json["event"] == "refused") {
    return;
  }
  if (finished.outcome.status == Status::ok) {
    finished_[key].push_back(finished);
  } else if (finished.outcome.exit_code == static_cast<int>(ExitCode::cannot_write)) {
    // Only the start in this journal is removed: another journal may record a run that made the
    // files.
    if (const auto found = started_.find(key);
        found != started_.end() && found->second.erase(path) > 0 && found->second.empty()) {
      started_.erase(found);
    }
  }
}

const Finished* JournalRecord::last(const std::string& key) const {
  const auto found = last_.find(key);
  return found == last_.end() ? nullptr : &found->second.finished;
}

const std::vector<Finished>& JournalRecord::finished(const std::string& key) const {
  static const std::vector<Finished> none;
  const auto found = finished_.find(key);
  return found == finished_.end() ? none : found->second;
}

std::string journal_of_shard(const std::string& path, std::size_t number, std::size_t count) {
  return count == 1 ? path : fmt::format("{}.{}{}{}", path, number, shard_mark, count);
}

std::vector<std::string> journals_of_list(const std::string& path) {
  std::vector<std::string> paths{path};
  const fs::path list(path);
  const std::string prefix = list.filename().string() + ".";
  std::error_code error;
  const fs::path folder = list.has_parent_path() ? list.parent_path() : fs::path(".");
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(prefix) && name.find(shard_mark, prefix.size()) != std::string::npos) {
      paths.push_back(entry.path().string());
    }
  }
  return paths;
}

}  // namespace ibmfair::commands
