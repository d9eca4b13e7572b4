// The documentation of a command that its parser does not have: units, defaults in words, examples.
// Help, man pages, completions and JSON are made from parser and documentation (usage/usage.h).
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/App.hpp>

namespace ibmfair::commands {

/// The groups of options that several commands share. They are listed after a command's own groups.
namespace groups {
inline constexpr const char* energy_and_flow = "Energy and flow";
inline constexpr const char* solver_and_memory = "Solver and memory";
inline constexpr const char* input_and_output = "Input and output";
inline constexpr const char* reports_and_pictures = "Reports and pictures";
inline constexpr const char* many_files = "Many files";
inline constexpr const char* every_command = "Every command";
}  // namespace groups

/// A working command line, and one line that says what it does.
struct Example {
  std::string command;
  std::string meaning;
};

/// An additional section of the help text.
struct Section {
  std::string title;
  std::string text;      ///< ends in a line feed
  bool further = false;  ///< about options that few users need
};

/// The documentation of an option or argument that the parser does not have.
struct OptionNote {
  std::string unit = {};
  std::string default_text = {};             ///< in words, if there is no default value
  std::vector<std::string> offers = {};      ///< some values, for completion in a shell
  std::vector<std::string> extensions = {};  ///< extensions of the files to offer first
};

struct Documentation {
  std::vector<Example> examples;
  std::vector<Section> sections;
  std::map<std::string, OptionNote> notes;  ///< key: the option's names as declared
};

/// A command's parser with its documentation.
class DocumentedApp : public CLI::App {
 public:
  using CLI::App::App;
  Documentation documentation;
};

/// The documentation of `app`, which must be a command of the table.
Documentation& documentation_of(CLI::App& app);
const Documentation& documentation_of(const CLI::App& app);

/// The note of an option of `app`; it is created empty if there is none.
OptionNote& note_of(CLI::App& app, const CLI::Option& option);

/// Options that are declared after this call belong to the group with this name.
void begin_group(CLI::App& app, const std::string& name);

}  // namespace ibmfair::commands
