#include "commands/effective_job.h"

#include <algorithm>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "commands/argument_roles.h"
#include "commands/shared_options.h"
#include "ibmfair/base/errors.h"

namespace ibmfair::commands {

namespace {

using nlohmann::ordered_json;

/// A JSON number if its text equals `text`, else a JSON string, so that `text` can be restored.
ordered_json value_json(const std::string& text) {
  ordered_json number = ordered_json::parse(text, nullptr, false);
  return number.is_number() && number.dump() == text ? number : ordered_json(text);
}

ordered_json values_json(const CLI::Option& option) {
  const std::vector<std::string> texts = given_values(option);
  const auto convert = [&](const std::string& text) {
    return role_of(option) == Role::value ? value_json(text) : ordered_json(text);
  };
  if (texts.size() == 1) {
    return convert(texts.front());
  }
  ordered_json list = ordered_json::array();
  for (const std::string& text : texts) {
    list.push_back(convert(text));
  }
  return list;
}

/// Whether the default value of the option must not be written: if an excluded option is given, or
/// if a needed option is not given, the parser would reject the job.
bool gives_way(const CLI::Option& option) {
  const auto excluded = option.get_excludes();
  const auto needed = option.get_needs();
  const auto is_given = [](const CLI::Option* other) { return other->count() > 0; };
  return std::any_of(excluded.begin(), excluded.end(), is_given) ||
         !std::all_of(needed.begin(), needed.end(), is_given);
}

/// Adds the argument or option with its given or default value, if there is one.
void add_value(const CLI::Option& option, ordered_json& place) {
  if (is_flag(option) && given_values(option).empty()) {
    place[key_of(option)] = option.count() > 0;
  } else if (option.count() > 0) {
    place[key_of(option)] = values_json(option);
  } else if (!option.get_default_str().empty() && !gives_way(option)) {
    place[key_of(option)] = value_json(option.get_default_str());
  }
}

}  // namespace

ordered_json effective_job(const CLI::App& command) {
  ordered_json job = {{"command", command.get_name()}};
  ordered_json options = ordered_json::object();
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_configurable()) {
      add_value(*option, option->get_positional() ? job : options);
    }
  }
  job["options"] = std::move(options);
  return job;
}

ordered_json options_in_force(const CLI::App& command) {
  ordered_json options = ordered_json::object();
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional() && option != command.get_help_ptr()) {
      add_value(*option, options);
    }
  }
  for (const char* name : {"dump-config", "json", "threads"}) {
    options.erase(name);
  }
  return options;
}

std::string job_file_text(const std::vector<ordered_json>& jobs) {
  const ordered_json file = {{"jobs", jobs}};
  std::string text = text_of(file);
  if (ordered_json::parse(text) != file) {
    throw BadOption("a job file cannot hold names that are not UTF-8");
  }
  return text;
}

}  // namespace ibmfair::commands
