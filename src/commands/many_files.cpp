#include "commands/many_files.h"

#include <algorithm>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "commands/argument_roles.h"
#include "commands/batch/batch_options.h"
#include "commands/batch/name_pattern.h"
#include "commands/batch/run_batch.h"
#include "commands/documentation.h"
#include "commands/effective_job.h"
#include "commands/shared_options.h"

namespace ibmfair::commands {

namespace {

struct ManyFiles {
  std::vector<std::string> inputs;
  std::string folder;
  std::string name = "{name}";
  BatchOptions options;
};

void declare_options(CLI::App& command, ManyFiles& many) {
  begin_group(command, groups::many_files);
  CLI::Option* folder =
      command.add_option("--out-dir", many.folder,
                         "process any number of files IN, and write the outputs under the same "
                         "names into this folder (instead of OUT)");
  folder->type_name("DIR")->configurable(false);
  std::vector<CLI::Option*> options = add_batch_options(command, many.options);
  options.push_back(
      command.add_option("--out-name", many.name,
                         "names of the outputs, for example {stem}.ply; {name}, {stem}, {ext} and "
                         "{dir} of the input also work in other options that name files"));
  note_of(command, *options.back()).default_text = "{name}";
  options.back()->type_name("PATTERN")->configurable(false);
  for (CLI::Option* option : options) {
    option->needs(folder);
  }
}

std::string output_pattern(const ManyFiles& many) {
  return literal_pattern(many.folder) + (many.folder.ends_with('/') ? "" : "/") + many.name;
}

/// The command's own options that were given.
std::vector<Setting> given_settings(const CLI::App& command) {
  std::vector<Setting> settings;
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional() && option->get_configurable() && option->count() > 0) {
      settings.push_back({key_of(*option), false,
                          is_flag(*option) ? std::vector<std::string>{} : option->results()});
    }
  }
  return settings;
}

nlohmann::ordered_json job_json(const CLI::App& command, const ManyFiles& many) {
  nlohmann::ordered_json job = {
      {"command", command.get_name()}, {"input", many.inputs}, {"output", output_pattern(many)}};
  job["options"] = effective_job(command)["options"];
  return job;
}

ExitCode run_many_files(CLI::App& command, const ManyFiles& many, Console& console) {
  if (many.options.dump_config) {
    write_standard_output(job_file_text({job_json(command, many)}));
    return ExitCode::done;
  }
  Job job{"", command.get_name(), many.inputs, given_settings(command)};
  job.settings.push_back({"output", true, {output_pattern(many)}});
  BatchOptions options = many.options;
  const auto given = [&](const char* name) {
    const CLI::Option* option = command.get_option_no_throw(name);
    return option != nullptr && option->count() > 0;
  };
  options.report.json = given("--json");
  options.overwrite = given("--overwrite");
  return run_batch(command, {job}, options, many.folder + "/.ibmfair-batch.journal", console);
}

}  // namespace

bool asks_for_many_files(const std::vector<std::string>& words) {
  const auto end = std::find(words.begin(), words.end(), "--");
  return std::any_of(words.begin(), end, [](const std::string& word) {
    return word == "--out-dir" || word.starts_with("--out-dir=");
  });
}

Runner take_many_files(CLI::App& command, Runner run, bool asked) {
  CLI::Option* input = input_argument(command);
  CLI::Option* output = output_argument(command);
  if (input == nullptr || output == nullptr || key_of(*input) != "input") {
    return run;
  }
  // With many files, --dry-run prints the commands of the batch, and an interrupted batch keeps
  // finished files only; so the command's own options of these names are removed.
  for (const char* name : {"--dry-run", "--checkpoint"}) {
    if (CLI::Option* own = command.get_option_no_throw(name); asked && own != nullptr) {
      command.remove_option(own);
    }
  }
  auto many = std::make_shared<ManyFiles>();
  declare_options(command, *many);
  if (!asked) {
    return [run = std::move(run), many](Console& console) { return run(console); };
  }
  command.remove_option(input);
  command.remove_option(output);
  CLI::Option* inputs = command.add_option("IN", many->inputs, "mesh files to read")->required();
  offer_meshes_to_read(command, *inputs);
  begin_group(command, groups::every_command);
  command.add_flag("--dump-config", many->options.dump_config,
                   "print these arguments and all defaults as a job, without running it");
  // The lambda holds `run`, because the command's own arguments live as long as its runner.
  return [run = std::move(run), many, &command](Console& console) {
    return run_many_files(command, *many, console);
  };
}

std::string many_files_hint(const CLI::App& command) {
  return command.get_option_no_throw("--out-dir") != nullptr && command.count("--out-dir") == 0
             ? " (--out-dir DIR takes many files)"
             : "";
}

}  // namespace ibmfair::commands
