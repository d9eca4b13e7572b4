#include "commands/program.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands/command.h"
#include "commands/help_format.h"
#include "commands/numeric_options.h"
#include "commands/process.h"
#include "commands/suggest.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/base/threads.h"
#include "ibmfair/base/version.h"

namespace ibmfair::commands {

namespace {

/// What the frame itself takes from the arguments.
struct FrameOptions {
  bool quiet = false;
  bool verbose = false;
  int threads = 0;
};

struct Declared {
  CLI::App* app;
  Runner run;
};

std::string version_text() {
  std::string text = fmt::format("ibmfair {}\n", version());
  for (const Component& component : component_versions()) {
    text += fmt::format("  {} {}\n", component.name, component.version);
  }
  return text;
}

void add_frame_options(CLI::App& app, FrameOptions& options) {
  CLI::Option* quiet = app.add_flag("-q,--quiet", options.quiet, "print errors only");
  app.add_flag("-v,--verbose", options.verbose, "print details")->excludes(quiet);
  add_integer(app, "--threads", options.threads, 0, largest_thread_count,
              "threads to compute with; 0, the default, is one a core");
}

std::vector<Declared> declare_commands(CLI::App& app, FrameOptions& options) {
  app.name("ibmfair");
  app.set_help_flag("-h,--help", "print this help");
  app.set_version_flag("--version", version_text,
                       "print the versions of the program and its parts");
  app.require_subcommand(1);
  app.footer("`ibmfair COMMAND --help` tells more about one of them.");
  app.formatter(std::make_shared<HelpFormatter>());
  std::vector<Declared> declared;
  for (const Command& command : command_table()) {
    CLI::App* sub = app.add_subcommand(std::string(command.name), std::string(command.summary));
    sub->footer("")->group("Commands");
    declared.push_back({sub, command.declare(*sub)});
    add_frame_options(*sub, options);
  }
  return declared;
}

std::vector<std::string> command_names() {
  std::vector<std::string> names;
  for (const Command& command : command_table()) {
    names.emplace_back(command.name);
  }
  return names;
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

/// What the user should read instead of the parser's own words: an option that nobody knows is the
/// likely cause of whatever else the parser complains about.
std::string explain(const CLI::ParseError& error, const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  if (chosen.empty()) {
    for (const std::string& word : app.remaining()) {
      if (!word.starts_with('-')) {
        return fmt::format("unknown command '{}'{}", word, suggestion(word, command_names()));
      }
      return fmt::format("unknown option '{}' before the command{}", word,
                         suggestion(word, option_names(app)));
    }
    return "no command given";
  }
  const CLI::App& command = *chosen.front();
  for (const std::string& word : command.remaining()) {
    const std::string name = word.substr(0, word.find('='));
    if (name.size() > 1 && name.starts_with('-')) {
      return fmt::format("{}: unknown option '{}'{}", command.get_name(), name,
                         suggestion(name, option_names(command)));
    }
  }
  if (!command.remaining().empty()) {
    return fmt::format("{}: '{}' is one argument too many", command.get_name(),
                       command.remaining().front());
  }
  return fmt::format("{}: {}", command.get_name(), error.what());
}

std::string help_hint(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return fmt::format("`ibmfair {}--help` lists what there is",
                     chosen.empty() ? "" : chosen.front()->get_name() + " ");
}

Console::Level level_of(const FrameOptions& options) {
  if (options.quiet) {
    return Console::Level::quiet;
  }
  return options.verbose ? Console::Level::verbose : Console::Level::normal;
}

ExitCode parse_and_run(int argc, const char* const* argv, Console& console) {
  CLI::App app("Fairs triangle meshes: removes noise and ripples without shrinking the shape.");
  FrameOptions options;
  const std::vector<Declared> commands = declare_commands(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForVersion& version) {
    write_standard_output(version.what());
    return ExitCode::done;
  } catch (const CLI::CallForHelp&) {
    write_standard_output(app.help());
    return ExitCode::done;
  } catch (const CLI::ParseError& error) {
    console.error(explain(error, app));
    console.note(help_hint(app));
    return ExitCode::usage;
  }
  console.set_level(level_of(options));
  set_thread_count(options.threads);
  const auto chosen = std::find_if(commands.begin(), commands.end(),
                                   [](const Declared& command) { return command.app->parsed(); });
  return chosen->run(console);
}

}  // namespace

int run_program(int argc, const char* const* argv) {
  prepare_process();
  Console console;
  ExitCode code = ExitCode::done;
  try {
    code = parse_and_run(argc, argv, console);
  } catch (...) {
    const Failure failure = describe_current_exception();
    console.error(failure.message);
    code = failure.code;
  }
  return static_cast<int>(code);
}

}  // namespace ibmfair::commands
