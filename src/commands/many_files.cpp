#include "commands/many_files.h"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/argument_roles.h"
#include "commands/batch/batch_options.h"
#include "commands/batch/name_pattern.h"
#include "commands/batch/run_batch.h"
#include "commands/documentation.h"
#include "commands/effective_job.h"
#include "commands/engine.h"
#include "commands/shared_options.h"

namespace ibmfair::commands {

namespace {

constexpr const char* folder_option = "--out-dir";
constexpr const char* name_option = "--out-name";
constexpr const char* further_inputs = "MORE";
constexpr const char* default_name = "{name}";

std::string value_of(const CLI::App& command, const char* name, const char* if_missing) {
  return is_given(command, name) ? command.get_option(name)->results().front() : if_missing;
}

/// All words of the command line that are no options: with --out-dir, each is an input.
std::vector<std::string> inputs_of(const CLI::App& command) {
  std::vector<std::string> inputs;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional()) {
      inputs.insert(inputs.end(), option->results().begin(), option->results().end());
    }
  }
  return inputs;
}

/// The pattern that gives the output of each input.
std::string output_pattern(const CLI::App& command) {
  const std::string folder = value_of(command, folder_option, "");
  return literal_pattern(folder) + (folder.ends_with('/') ? "" : "/") +
         value_of(command, name_option, default_name);
}

/// The command's own options that were given.
std::vector<Setting> given_settings(const CLI::App& command) {
  std::vector<Setting> settings;
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional() && option->get_configurable() && option->count() > 0) {
      settings.push_back({key_of(*option), false, given_values(*option)});
    }
  }
  return settings;
}

/// Declares --out-dir. With it, `output` is one more input, and any number of further inputs may
/// follow.
CLI::Option* add_folder(CLI::App& command, CLI::Option* output) {
  CLI::Option* folder = command.add_option_function<std::string>(
      folder_option, [output](const std::string&) { output->required(false); },
      "process any number of files IN, and write the outputs under the same names into this folder "
      "(instead of OUT)");
  folder->type_name("DIR")->configurable(false);
  if (CLI::Option* checkpoint = command.get_option_no_throw("--checkpoint")) {
    folder->excludes(checkpoint);  // an interrupted batch keeps finished files only
  }
  const auto require_folder = [folder, &command](const std::vector<std::string>& words) {
    if (folder->count() == 0 && !passes_options_on(command)) {
      throw CLI::ParseError(fmt::format("'{}' is one argument too many ({} DIR takes many files)",
                                        words.front(), folder_option),
                            CLI::ExitCodes::ExtrasError);
    }
  };
  command.add_option_function<std::vector<std::string>>(further_inputs, require_folder)
      ->configurable(false)
      ->group("");  // hidden
  return folder;
}

ExitCode run_many_files(CLI::App& command, BatchOptions options, Console& console) {
  Job job{"", command.get_name(), inputs_of(command), given_settings(command)};
  job.settings.push_back({"output", true, {output_pattern(command)}});
  options.report.json = is_given(command, "--json");
  options.overwrite = is_given(command, "--overwrite");
  options.dry_run = is_given(command, "--dry-run");
  return run_batch(command, {job}, options,
                   value_of(command, folder_option, "") + "/.ibmfair-batch.journal", console);
}

}  // namespace

bool takes_many_files(const CLI::App& command) {
  return is_given(command, folder_option);
}

nlohmann::ordered_json job_of(const CLI::App& command) {
  if (!takes_many_files(command)) {
    return effective_job(command);
  }
  nlohmann::ordered_json job = {{"command", command.get_name()},
                                {"input", inputs_of(command)},
                                {"output", output_pattern(command)}};
  job["options"] = effective_job(command)["options"];
  return job;
}

Runner take_many_files(CLI::App& command, Runner run) {
  CLI::Option* input = input_argument(command);
  CLI::Option* output = output_argument(command);
  if (input == nullptr || output == nullptr || key_of(*input) != "input") {
    return run;
  }
  begin_group(command, groups::many_files);
  CLI::Option* folder = add_folder(command, output);
  auto options = std::make_shared<BatchOptions>();
  std::vector<CLI::Option*> of_batch = add_batch_options(command, *options);
  of_batch.push_back(command.add_option(
      name_option,
      "names of the outputs, for example {stem}.ply; {name}, {stem}, {ext} and {dir} "
      "of the input also work in other options that name files"));
  note_of(command, *of_batch.back()).default_text = default_name;
  of_batch.back()->type_name("PATTERN")->configurable(false);
  for (CLI::Option* option : of_batch) {
    option->needs(folder);
  }
  return [run = std::move(run), options, &command](Host& host) {
    return takes_many_files(command) ? run_many_files(command, *options, host.console())
                                     : run(host);
  };
}

}  // namespace ibmfair::commands
