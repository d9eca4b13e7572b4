#include "commands/help_format.h"

#include <algorithm>
#include <sstream>

#include <CLI/CLI.hpp>

namespace ibmfair::commands {

namespace {

constexpr std::size_t left_column = 26;
constexpr std::size_t line_width = 100;

// `TEXT:{mass,identity}`, as the parser names a choice, becomes `mass|identity`.
std::string readable(std::string type) {
  const std::size_t open = type.find('{');
  if (open != std::string::npos && type.back() == '}') {
    type = type.substr(open + 1, type.size() - open - 2);
    std::replace(type.begin(), type.end(), ',', '|');
  }
  return type;
}

}  // namespace

HelpFormatter::HelpFormatter() {
  column_width(left_column);
  label("Positionals", "Arguments");
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
  const bool takes_text = option->get_items_expected_max() > 0 && !option->get_positional();
  return takes_text ? " " + readable(option->get_type_name()) : "";
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
  std::istringstream words(option->get_description());
  std::string text;
  std::size_t column = left_column;
  for (std::string word; words >> word;) {
    if (!text.empty() && column + 1 + word.size() > line_width) {
      text += '\n';
      column = left_column;
    } else if (!text.empty()) {
      text += ' ';
      ++column;
    }
    text += word;
    column += word.size();
  }
  return text;
}

std::string HelpFormatter::make_usage(const CLI::App* app, std::string name) const {
  std::string text = "\nUsage: " + name;
  if (app->get_subcommands({}).empty()) {
    for (const CLI::Option* option : app->get_options(
             [](const CLI::Option* candidate) { return candidate->get_positional(); })) {
      const std::string& word = option->get_single_name();
      text += option->get_required() ? " " + word : " [" + word + "]";
    }
    text += " [OPTION...]";
  } else {
    text += " COMMAND [ARGUMENT...]";
  }
  return text + "\n";
}

}  // namespace ibmfair::commands
