#include "commands/batch/item.h"

#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/argument_roles.h"
#include "commands/batch/input_names.h"
#include "commands/batch/item_conflicts.h"
#include "commands/batch/name_pattern.h"
#include "commands/command_line.h"
#include "commands/effective_job.h"
#include "commands/shared_options.h"
#include "ibmfair/base/errors.h"

namespace ibmfair::commands {

namespace {

/// The job's settings for one input, with the patterns of file names expanded.
std::vector<Setting> settings_for(const Job& job, const CLI::App& command,
                                  const std::string& input) {
  std::vector<Setting> settings = job.settings;
  for (Setting& setting : settings) {
    const CLI::Option* option = find_argument(command, setting.key, setting.positional);
    if (option != nullptr && role_of(*option) != Role::value) {
      for (std::string& value : setting.values) {
        value = expand_pattern(value, input);
      }
    }
  }
  return settings;
}

void collect_files(CLI::App& command, Item& item) {
  for (const CLI::Option* option : command.get_options()) {
    const Role role = role_of(*option);
    for (const std::string& path : option->results()) {
      if ((role == Role::reads || role == Role::writes) && path == "-") {
        throw BadOption(
            fmt::format("{}: '-' is standard input or output, which the files of a batch do "
                        "not have; name a file",
                        key_of(*option)));
      }
      std::error_code ignored;
      if (role == Role::reads ||
          (role == Role::might_read && std::filesystem::is_regular_file(path, ignored))) {
        item.reads.push_back(path);
      } else if (role == Role::writes) {
        item.writes.insert(option->get_positional() ? item.writes.begin() : item.writes.end(),
                           path);
      }
    }
  }
  const auto file_of = [](const CLI::Option* option) {
    return option == nullptr || option->count() == 0 ? std::string() : option->results().front();
  };
  item.input = file_of(input_argument(command));
  item.output = file_of(output_argument(command));
}

Item make_item(const Job& job, const std::string& input) {
  CommandLine line(job.command);
  CLI::App& command = line.command();
  std::vector<Setting> settings = settings_for(job, command, input);
  if (!input.empty()) {
    settings.push_back({key_of(*input_argument(command)), true, {input}});
  }
  Item item;
  item.place = job.place;
  item.command = job.command;
  item.words = words_for(command, settings);
  line.parse(item.words);
  collect_files(command, item);
  const nlohmann::ordered_json job_json = effective_job(command);
  item.job = text_of(job_json);
  item.job_is_exact = nlohmann::ordered_json::parse(item.job) == job_json;
  const auto has = [&](const char* name) { return command.get_option_no_throw(name) != nullptr; };
  item.takes_overwrite = has("--overwrite");
  item.overwrite = item.takes_overwrite && command.count("--overwrite") > 0;
  item.takes_json = has("--json");
  item.has_threads = command.count("--threads") > 0;
  return item;
}

/// The input files of the job; each entry tells whether a glob found the file.
std::vector<InputName> inputs_of(const Job& job) {
  if (job.inputs.empty()) {
    return {InputName{}};  // a command without input runs once
  }
  std::vector<InputName> names;
  for (const std::string& pattern : job.inputs) {
    const std::vector<InputName> found = find_inputs(pattern);
    names.insert(names.end(), found.begin(), found.end());
  }
  return names;
}

std::vector<Item> items_of(const Job& job) {
  std::vector<Item> items;
  std::vector<bool> found_by_glob;
  for (const InputName& input : inputs_of(job)) {
    items.push_back(make_item(job, input.path));
    found_by_glob.push_back(input.by_glob);
  }
  // A job that writes into the folder of its inputs must give the same items when it is run again.
  return without_own_outputs(std::move(items), found_by_glob);
}

}  // namespace

std::string Item::label() const {
  if (input.empty()) {
    return output.empty() ? command : output;
  }
  return output.empty() ? input : fmt::format("{} -> {}", input, output);
}

std::vector<Item> expand_jobs(const std::vector<Job>& jobs) {
  std::vector<Item> all;
  for (const Job& job : jobs) {
    try {
      for (Item& item : items_of(job)) {
        item.number = all.size() + 1;
        all.push_back(std::move(item));
      }
    } catch (const BadOption& error) {
      throw BadOption(job.place + error.what());
    } catch (const BadFile& error) {
      throw BadFile(job.place + error.what());
    }
  }
  require_inputs(all);
  reject_conflicts(all);
  return all;
}

}  // namespace ibmfair::commands
