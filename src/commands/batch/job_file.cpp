#include "commands/batch/job_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iostream>
#include <iterator>
#include <set>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/argument_roles.h"
#include "commands/batch/json_text.h"
#include "commands/command_line.h"
#include "commands/suggest.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/base/short_text.h"

namespace ibmfair::commands {

namespace {

using nlohmann::ordered_json;

[[noreturn]] void fail(const std::string& place, const std::string& key, const std::string& text) {
  throw BadFile(fmt::format("{}key '{}': {}", place, short_text(key, 40), short_text(text)));
}

/// The value of an option or argument as text on the command line.
std::string scalar_text(const ordered_json& value, const std::string& place,
                        const std::string& key) {
  if (value.is_string()) {
    auto text = value.get<std::string>();
    if (text.find('\0') != std::string::npos) {
      // A command-line argument would end at this character, and would not be the checked name.
      fail(place, key, "a text cannot hold a zero character");
    }
    return text;
  }
  if (value.is_number()) {
    return value.dump();
  }
  fail(place, key, fmt::format("a text or a number is needed, not {}", shown(value)));
}

std::vector<std::string> texts(const ordered_json& value, const std::string& place,
                               const std::string& key) {
  std::vector<std::string> result;
  if (value.is_array()) {
    for (const ordered_json& entry : value) {
      result.push_back(scalar_text(entry, place, key));
    }
  } else {
    result.push_back(scalar_text(value, place, key));
  }
  return result;
}

/// The keys of a command's arguments or options.
std::vector<std::string> keys_of(const CLI::App& command, bool positional) {
  std::vector<std::string> keys;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_configurable() && option->get_positional() == positional) {
      keys.push_back(key_of(*option));
    }
  }
  return keys;
}

/// One object of the file: a job or the defaults.
struct Entry {
  const ordered_json& json;
  std::string place;
  ordered_json options;
};

Entry checked_entry(const ordered_json& json, const std::string& place) {
  if (!json.is_object()) {
    throw BadFile(fmt::format("{}an object is needed, not {}", place, shown(json)));
  }
  Entry entry{json, place, json.value("options", ordered_json::object())};
  if (!entry.options.is_object()) {
    fail(place, "options", "an object is needed, as {\"steps\": 16}");
  }
  return entry;
}

/// Builds the jobs, and records which defaults apply to at least one job.
class JobReader {
 public:
  JobReader(const ordered_json& file, const std::string& name)
      : name_(name),
        default_json_(file.value("defaults", ordered_json::object())),
        defaults_(checked_entry(default_json_, name + ": defaults: ")) {}

  Job read(const ordered_json& json, std::size_t number) {
    const Entry entry = checked_entry(json, fmt::format("{}: job {}: ", name_, number));
    Job job{entry.place, command_of(entry)};
    CommandLine line = declare(job);
    const CLI::App& command = line.command();
    reject_unknown(entry, command);
    read_arguments(entry, line.command(), job);
    read_options(entry, command, job);
    return job;
  }

  /// Throws if a default applies to no job.
  void require_defaults_used() const {
    for (const auto& [key, value] : default_json_.items()) {
      if (key != "command" && key != "options" && !known_arguments_.contains(key)) {
        fail(defaults_.place, key, "unknown" + suggestion(key, list(known_arguments_)));
      }
    }
    for (const auto& [key, value] : defaults_.options.items()) {
      if (!known_options_.contains(key)) {
        fail(defaults_.place, "options." + key,
             "no command of this file has this option" + suggestion(key, list(known_options_)));
      }
    }
  }

 private:
  static std::vector<std::string> list(const std::set<std::string>& set) {
    return {set.begin(), set.end()};
  }

  std::string command_of(const Entry& entry) const {
    const Entry& source = entry.json.contains("command") ? entry : defaults_;
    if (!source.json.contains("command")) {
      fail(entry.place, "command", "missing, and there is no default");
    }
    const ordered_json& command = source.json["command"];
    if (!command.is_string()) {
      fail(source.place, "command", fmt::format("a text is needed, not {}", shown(command)));
    }
    if (command == "batch") {
      fail(source.place, "command", "a batch cannot hold a batch");
    }
    return command;
  }

  static CommandLine declare(const Job& job) {
    try {
      return CommandLine(job.command);
    } catch (const BadOption& error) {
      throw BadOption(job.place + error.what());
    }
  }

  void reject_unknown(const Entry& entry, const CLI::App& command) {
    std::vector<std::string> keys = keys_of(command, true);
    known_arguments_.insert(keys.begin(), keys.end());
    keys.insert(keys.end(), {"command", "options"});
    for (const auto& [key, value] : entry.json.items()) {
      if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
        fail(entry.place, key,
             fmt::format("unknown to {}{}", command.get_name(), suggestion(key, keys)));
      }
    }
    const std::vector<std::string> options = keys_of(command, false);
    known_options_.insert(options.begin(), options.end());
    for (const auto& [key, value] : entry.options.items()) {
      if (std::find(options.begin(), options.end(), key) == options.end()) {
        fail(entry.place, "options." + key,
             fmt::format("{} has no such option{}", command.get_name(), suggestion(key, options)));
      }
    }
  }

  void read_arguments(const Entry& entry, CLI::App& command, Job& job) const {
    const CLI::Option* input = input_argument(command);
    for (const std::string& key : keys_of(command, true)) {
      const Entry& source = entry.json.contains(key) ? entry : defaults_;
      if (!source.json.contains(key)) {
        continue;
      }
      const std::vector<std::string> values = texts(source.json[key], source.place, key);
      if (input != nullptr && key == key_of(*input)) {
        job.inputs = values;
      } else if (values.size() != 1) {
        fail(source.place, key, "one name is needed");
      } else {
        job.settings.push_back({key, true, values});
      }
    }
    if (input != nullptr && job.inputs.empty()) {
      fail(entry.place, key_of(*input), fmt::format("missing; {} needs it", job.command));
    }
  }

  void read_options(const Entry& entry, const CLI::App& command, Job& job) const {
    ordered_json merged = defaults_.options;
    for (const auto& [key, value] : entry.options.items()) {
      merged[key] = value;
    }
    for (const auto& [key, value] : merged.items()) {
      const CLI::Option* option = find_argument(command, key, false);
      if (option != nullptr && !value.is_null()) {
        read_option(*option, value, entry.options.contains(key) ? entry.place : defaults_.place,
                    job);
      }
    }
  }

  static void read_option(const CLI::Option& option, const ordered_json& value,
                          const std::string& place, Job& job) {
    const std::string key = key_of(option);
    if (is_flag(option) != value.is_boolean() &&
        !(has_optional_value(option) && (value.is_string() || value.is_number()))) {
      const char* wanted = has_optional_value(option) ? "true, false or a value"
                           : is_flag(option)          ? "true or false"
                                                      : "a value";
      fail(place, "options." + key, fmt::format("{} is needed, not {}", wanted, shown(value)));
    }
    if (value.is_boolean()) {
      if (value.get<bool>()) {
        job.settings.push_back({key});
      }
      return;
    }
    std::vector<std::string> values = texts(value, place, "options." + key);
    if (option.get_items_expected_max() == 1 && values.size() > 1) {
      values = {fmt::format("{}", fmt::join(values, ","))};  // as X,Y,Z
    }
    job.settings.push_back({key, false, values});
  }

  const std::string& name_;
  ordered_json default_json_;
  Entry defaults_;
  std::set<std::string> known_arguments_;
  std::set<std::string> known_options_;
};

}  // namespace

std::vector<Job> parse_jobs(std::string_view text, const std::string& name) {
  const ordered_json file = parse_json_text(text, name);
  if (!file.is_object() || !file.contains("jobs") || !file["jobs"].is_array()) {
    throw BadFile(name + ": a list of jobs is needed, as {\"jobs\": [{...}, ...]}");
  }
  for (const auto& [key, value] : file.items()) {
    if (key != "jobs" && key != "defaults") {
      fail(name + ": ", key, "unknown" + suggestion(key, {"jobs", "defaults"}));
    }
  }
  JobReader reader(file, name);
  std::vector<Job> jobs;
  for (const ordered_json& json : file["jobs"]) {
    jobs.push_back(reader.read(json, jobs.size() + 1));
  }
  if (!jobs.empty()) {
    reader.require_defaults_used();
  }
  return jobs;
}

std::vector<Job> read_jobs(const std::string& path) {
  std::ifstream file;
  if (path != "-") {
    file.open(path, std::ios::binary);
  }
  std::istream& stream = path == "-" ? std::cin : file;
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream || stream.bad()) {
    throw BadFile(path + ": cannot be read: " + std::strerror(errno));
  }
  return parse_jobs(text, path == "-" ? "standard input" : path);
}

}  // namespace ibmfair::commands
