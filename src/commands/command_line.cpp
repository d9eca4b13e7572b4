#include "commands/command_line.h"

#include <algorithm>
#include <deque>
#include <functional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/argument_roles.h"
#include "commands/crash_message.h"
#include "commands/documentation.h"
#include "commands/effective_job.h"
#include "commands/engine.h"
#include "commands/length.h"
#include "commands/many_files.h"
#include "commands/numeric_options.h"
#include "commands/parser_words.h"
#include "commands/suggest.h"
#include "commands/usage/generators.h"
#include "commands/usage/help_text.h"
#include "commands/usage/usage_json.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/base/threads.h"
#include "ibmfair/base/version.h"
#include "ibmfair/flow/linear_system/jacobian_solver.h"

namespace ibmfair::commands {

/// The options that every command has.
struct FrameOptions {
  bool quiet = false;
  bool verbose = false;
  bool dump_config = false;
  int threads = 0;
};

/// A command of the table. Its options are declared only when they are needed, because most runs
/// use one command, and declaring the options of all commands takes longer than parsing.
struct NamedCommand {
  const Command& row;
  CLI::App* app;
  Runner run = {};  ///< empty: its options are not declared yet
};

namespace {

constexpr const char* help_command = "help";

/// Ends the parsing with a text to print, regardless of other arguments, like --version does.
[[noreturn]] void answer_with(const std::string& text) {
  throw CLI::CallForVersion(text, 0);
}

/// Declares options that ask about the program, or about its command `app`, instead of running a
/// command.
void add_questions(CLI::App& app, const std::function<ProgramUsage()>& program) {
  const bool is_program = app.get_parent() == nullptr;
  const auto usage = [&app, program, is_program](auto of_program, auto of_command) {
    return is_program ? of_program(program()) : of_command(program(), usage_of_command(app));
  };
  app.set_help_flag("-h,--help", "print this help");
  app.add_flag_callback(
         "--json-usage",
         [usage] {
           answer_with(usage(
               [](const ProgramUsage& p) { return usage_json(p); },
               [](const ProgramUsage& p, const CommandUsage& c) { return usage_json(p, c); }));
         },
         "print what this help says as JSON, for programs")
      ->configurable(false);
  CLI::Option* generate = app.add_option_function<std::string>(
      "--generate",
      [usage](const std::string& name) {
        for (const Generator& generator : generators()) {
          if (generator.name == name) {
            answer_with(usage([&](const ProgramUsage& p) { return generator.make(p, nullptr); },
                              [&](const ProgramUsage& p, const CommandUsage& c) {
                                return generator.make(p, &c);
                              }));
          }
        }
      },
      "print a man page, or completions for a shell");
  generate->check(CLI::IsMember(generator_names()))->configurable(false);
  if (!is_program) {
    generate->group("");  // hidden: except for the man page, the text is the same for all commands
  }
}

/// The versions of the program and its parts, and if `loaded`, of what single solvers load.
std::string version_text(bool loaded) {
  std::string text = fmt::format("ibmfair {}\n", version());
  const auto add = [&](const std::vector<Component>& components) {
    for (const Component& component : components) {
      text += fmt::format("  {} {}\n", component.name, component.version);
    }
  };
  add(component_versions());
  for (const JacobianBackend& backend : jacobian_backends()) {
    if (!loaded || backend.load == nullptr) continue;
    try {
      add(backend.load());
    } catch (const Error& error) {
      text += fmt::format("  {}\n", error.what());
    }
  }
  return text;
}

void add_frame_options(CLI::App& app, FrameOptions& options) {
  begin_group(app, groups::every_command);
  CLI::Option* quiet = app.add_flag("-q,--quiet", options.quiet, "print errors only");
  app.add_flag("-v,--verbose", options.verbose, "print details")->excludes(quiet);
  CLI::Option* threads = add_integer(app, "--threads", options.threads, 0, largest_thread_count,
                                     "threads to compute with; 0 is one a core");
  threads->default_str("");  // no value: a job without --threads gets its share of the cores
  note_of(app, *threads) = {.unit = "threads", .default_text = "0"};
  if (app.get_option_no_throw("--dump-config") == nullptr) {
    app.add_flag(
        "--dump-config", options.dump_config,
        "print these arguments and all defaults as a job for `ibmfair batch`, without running it");
  }
  for (const char* name : {"--quiet", "--verbose", "--dump-config"}) {
    app.get_option(name)->configurable(false);
  }
}

std::vector<std::string> command_names() {
  std::vector<std::string> names;
  for (const Command& command : command_table()) {
    names.emplace_back(command.name);
  }
  names.emplace_back(help_command);
  return names;
}

std::string unknown_command(const std::string& name) {
  return fmt::format("unknown command '{}'{}", name, suggestion(name, command_names()));
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      names.push_back("--" + name);
    }
    for (const std::string& name : option->get_snames()) {
      names.push_back("-" + name);
    }
  }
  return names;
}

/// The message for the user, instead of the parser's own message `error`. An unknown option is
/// reported first, because it probably caused the parser's error.
std::string explain(const char* error, const CLI::App& app) {
  if (!app.remaining().empty()) {
    const std::string word = app.remaining().front();
    return word.starts_with('-') ? fmt::format("unknown option '{}' before the command{}", word,
                                               suggestion(word, option_names(app)))
                                 : unknown_command(word);
  }
  const auto chosen = app.get_subcommands();
  if (chosen.empty()) {
    return "no command given";
  }
  const CLI::App& command = *chosen.front();
  std::vector<std::string> left = command.remaining();
  std::erase(left, "--");
  for (const std::string& word : left) {
    const std::string name = word.substr(0, word.find('='));
    if (name.size() > 1 && name.starts_with('-')) {
      return fmt::format("{}: unknown option '{}'{}", command.get_name(), name,
                         suggestion(name, option_names(command)));
    }
  }
  if (!left.empty()) {
    return fmt::format("{}: '{}' is one argument too many", command.get_name(), left.front());
  }
  return fmt::format("{}: {}", command.get_name(), in_plain_words(error));
}

/// Runs the command. Messages about the geometry of its only input name the file.
ExitCode run_naming_input(const NamedCommand& command, Host& host) {
  const CLI::Option* input = input_argument(*command.app);
  if (input == nullptr || key_of(*input) != "input" || input->count() == 0) {
    return command.run(host);
  }
  const std::string path = input->results().front();
  const std::string name = path == "-" ? "standard input" : path;
  const auto named = [&](const std::string& message) {
    return message.find(name) != std::string::npos ? message : fmt::format("{}: {}", name, message);
  };
  try {
    return command.run(host);
  } catch (const BadMesh& error) {
    throw BadMesh(named(error.what()));
  } catch (const FactorizationFailed& error) {
    throw FactorizationFailed(named(error.what()));
  }
}

/// Rewrites `help smooth` as `smooth --help`, and `help` as `--help`. --all is for the help itself.
std::vector<std::string> question_for_help(std::vector<std::string> words) {
  words.erase(words.begin());
  std::erase(words, "--all");
  if (words.size() > 1) {
    throw Misuse(fmt::format("help: '{}' is one argument too many", words[1]));
  }
  if (words == std::vector<std::string>{help_command}) {
    words.clear();
  }
  words.emplace_back("--help");
  return words;
}

Console::Level level_of(const FrameOptions& options) {
  if (options.quiet) {
    return Console::Level::quiet;
  }
  return options.verbose ? Console::Level::verbose : Console::Level::normal;
}

}  // namespace

struct CommandLine::Parts {
  CLI::App app{"Fairs triangle meshes: removes noise and ripples without shrinking the shape."};
  FrameOptions options;
  bool explain_all = false;           // the help of a command explains all options
  bool asks_for_details = false;      // the versions include those of what solvers load
  std::deque<NamedCommand> commands;  // a deque, because callbacks refer to the elements

  Parts() {
    app.name("ibmfair");
    app.option_defaults()->group("Instead of a command");
    app.set_version_flag(
        "--version", [this] { return version_text(asks_for_details); },
        "print the versions of the program and its parts; with -v also of what solvers load");
    add_questions(app, [this] { return usage(); });
    app.require_subcommand(1);
  }

  NamedCommand& name(const Command& row) {
    CLI::App* sub = app.add_subcommand(
        std::make_shared<DocumentedApp>(std::string(row.summary), std::string(row.name)));
    NamedCommand& command = commands.emplace_back(NamedCommand{row, sub});
    sub->preparse_callback([this, &command](std::size_t) { declare(command); });
    return command;
  }

  void declare(NamedCommand& command) {
    if (!command.run) {
      command.run = take_many_files(*command.app, command.row.declare(*command.app));
      add_frame_options(*command.app, options);
      add_questions(*command.app, [this] { return usage(); });
    }
  }

  ProgramUsage usage() {
    for (NamedCommand& command : commands) {
      declare(command);
    }
    return usage_of_program(app);
  }

  /// The help of the command that was named, or else of the program. Throws Misuse if the name is
  /// not a command.
  std::string help() {
    const auto named = app.get_subcommands();
    if (!named.empty()) {
      return help_text(usage_of_command(*named.front()), help_width(), explain_all);
    }
    const std::vector<std::string> words = app.remaining();
    if (!words.empty() && !words.front().starts_with('-')) {
      throw Misuse(unknown_command(words.front()));
    }
    return help_text(usage(), help_width());
  }

  const NamedCommand& chosen() const {
    return commands.size() == 1 ? commands.front()
                                : *std::find_if(commands.begin(), commands.end(),
                                                [](const auto& c) { return c.app->parsed(); });
  }
};

CommandLine::CommandLine() : parts_(std::make_unique<Parts>()) {
  for (const Command& row : command_table()) {
    parts_->name(row);
  }
}

CommandLine::CommandLine(std::string_view command) : parts_(std::make_unique<Parts>()) {
  const auto table = command_table();
  const auto row = std::find_if(table.begin(), table.end(),
                                [&](const Command& known) { return known.name == command; });
  if (row == table.end()) {
    throw BadOption(unknown_command(std::string(command)));
  }
  parts_->declare(parts_->name(*row));
}

CommandLine::CommandLine(const Command& command) : parts_(std::make_unique<Parts>()) {
  parts_->declare(parts_->name(command));
}

CommandLine::~CommandLine() = default;

std::optional<std::string> CommandLine::parse(std::vector<std::string> words) {
  const auto has = [&](const char* word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  parts_->explain_all = has("--all");
  parts_->asks_for_details = has("-v") || has("--verbose");
  if (!words.empty() && words.front() == help_command) {
    words = question_for_help(std::move(words));
  }
  words = join_optional_lengths(std::move(words));
  std::reverse(words.begin(), words.end());  // the parser takes them from the back
  try {
    parts_->app.parse(std::move(words));
  } catch (const CLI::CallForVersion& version) {
    return version.what();
  } catch (const CLI::CallForHelp&) {
    return parts_->help();
  } catch (const CLI::ParseError& error) {
    throw Misuse(explain(error.what(), parts_->app));
  }
  const CLI::App& chosen = command();
  if (chosen.remaining_size() > 0 && !passes_options_on(chosen)) {
    throw Misuse(explain("", parts_->app));
  }
  return std::nullopt;
}

CLI::App& CommandLine::command() {
  return *parts_->chosen().app;
}

std::string CommandLine::help_hint() const {
  const auto chosen = parts_->app.get_subcommands();
  if (!chosen.empty()) {
    return fmt::format("`ibmfair help {}` explains this command", chosen.front()->get_name());
  }
  return "`ibmfair help` lists all commands";
}

std::string CommandLine::first_commands() const {
  return parts_->app.get_subcommands().empty() && parts_->app.remaining().empty()
             ? commands::first_commands(parts_->usage(), help_width())
             : "";
}

ExitCode CommandLine::run(Host& host) {
  const NamedCommand& chosen = parts_->chosen();
  const FrameOptions& options = parts_->options;
  if (options.dump_config) {
    write_standard_output(job_file_text({job_of(*chosen.app)}));
    return ExitCode::done;
  }
  host.console().set_level(level_of(options));
  set_thread_count(options.threads);
  if (host.console().listener() == nullptr) {
    note_stage(chosen.app->get_name());
  }
  return run_naming_input(chosen, host);
}

}  // namespace ibmfair::commands
