// What is said of a command besides what its parser knows: units, defaults in words, examples.
// Help, man pages, completions and JSON are made of both: usage/usage.h.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/App.hpp>

namespace ibmfair::commands {

/// The groups of options that several commands have, which stand behind a command's own.
namespace groups {
inline constexpr const char* energy_and_flow = "Energy and flow";
inline constexpr const char* solver_and_memory = "Solver and memory";
inline constexpr const char* input_and_output = "Input and output";
inline constexpr const char* reports_and_pictures = "Reports and pictures";
inline constexpr const char* many_files = "Many files";
inline constexpr const char* every_command = "Every command";
}  // namespace groups

/// A command line that works, and one line on what it is good for.
struct Example {
  std::string command;
  std::string meaning;
};

/// A part of the help with lines of its own.
struct Section {
  std::string title;
  std::string text;      ///< ends in a line feed
  bool further = false;  ///< belongs to options that few people need
};

/// What the parser does not know of an option or argument.
struct OptionNote {
  std::string unit = {};
  std::string default_text = {};             ///< in words, where no value says it
  std::vector<std::string> offers = {};      ///< values for a shell to offer, not all there are
  std::vector<std::string> extensions = {};  ///< of the files it names, those to offer first
};

struct Documentation {
  std::vector<Example> examples;
  std::vector<Section> sections;
  std::map<std::string, OptionNote> notes;  ///< by the option's names as declared
};

/// A command's parser with its documentation.
class DocumentedApp : public CLI::App {
 public:
  using CLI::App::App;
  Documentation documentation;
};

/// Of a command of the table.
Documentation& documentation_of(CLI::App& app);
const Documentation& documentation_of(const CLI::App& app);

/// The note of an option that `app` has, empty at first.
OptionNote& note_of(CLI::App& app, const CLI::Option& option);

/// Options declared from here on belong to the group of this name.
void begin_group(CLI::App& app, const std::string& name);

}  // namespace ibmfair::commands
