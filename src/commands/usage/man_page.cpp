// Pages for man(1): one for the program and one for each command, as for git. `man ibmfair smooth`
// shows ibmfair-smooth(1).
#include <cstdlib>
#include <ctime>
#include <string_view>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "commands/usage/generators.h"

namespace ibmfair::commands {

namespace {

/// The text in roff syntax: requests and escapes are neutralised, text in backticks becomes bold,
/// and a hyphen becomes the ASCII hyphen that a shell accepts.
std::string roff(const std::string& text) {
  std::string result;
  bool bold = false;
  for (const char c : text) {
    switch (c) {
      case '\\':
        result += "\\e";
        break;
      case '-':
        result += "\\-";
        break;
      case '\'':
        result += "\\(aq";
        break;
      case '"':
        result += "\\(dq";
        break;
      case '`':
        bold = !bold;
        result += bold ? "\\fB" : "\\fR";
        break;
      case '.':
        result += result.empty() || result.back() == '\n' ? "\\&." : ".";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string paragraph(const std::string& text) {
  return fmt::format(".PP\n{}\n", roff(text));
}

/// A heading, followed by paragraphs of which the first loses its leading space.
std::string part(const std::string& heading, const std::string& paragraphs) {
  constexpr std::string_view space = ".PP\n";
  return fmt::format(".SH {}\n{}", roff(heading),
                     std::string_view(paragraphs).substr(space.size()));
}

/// A term in bold, and its meaning.
std::string definition(const std::string& term, const std::string& meaning) {
  return fmt::format(".TP\n\\fB{}\\fR\n{}\n", roff(term), roff(meaning));
}

/// Lines without filling, as in the input.
std::string verbatim(const std::string& text) {
  return fmt::format(".PP\n.nf\n.RS 4\n{}.RE\n.fi\n", roff(text));
}

std::string sentence(std::string text) {
  if (!text.empty() && text.front() >= 'a' && text.front() <= 'z') {
    text.front() = static_cast<char>(text.front() - 'a' + 'A');
  }
  return text + (text.ends_with('.') ? "" : ".");
}

/// The heading `--cutoff LENGTH`, with the names in bold and the value in italics.
std::string roff_heading(const OptionUsage& option) {
  std::string text = option.letter.empty() ? fmt::format(R"(\fB{}\fR)", roff(option.name))
                                           : fmt::format(R"(\fB{}\fR, \fB{}\fR)",
                                                         roff(option.letter), roff(option.name));
  if (!option.value.empty() && option.name.starts_with('-')) {
    text += fmt::format(" \\fI{}\\fR", roff(option.value));
  }
  if (!option.optional_value.empty()) {
    text += fmt::format(" [\\fI{}\\fR]", roff(option.optional_value));
  }
  return text;
}

std::string roff_options(const std::vector<OptionUsage>& options) {
  std::string text = ".SH OPTIONS\n";
  for (const std::string& group : groups_of(options)) {
    text += fmt::format(".SS {}\n", roff(group));
    for (const OptionUsage& option : options) {
      if (option.group == group) {
        text +=
            fmt::format(".TP\n{}\n{}\n", roff_heading(option), roff(full_help_of(option, options)));
      }
    }
  }
  return text;
}

std::string roff_examples(const std::vector<Example>& examples) {
  std::string text;
  for (const Example& example : examples) {
    text += paragraph(sentence(example.meaning)) + verbatim(example.command + "\n");
  }
  return text.empty() ? text : part("EXAMPLES", text);
}

/// The current date, or the date in SOURCE_DATE_EPOCH, which allows reproducible builds.
std::string date() {
  const char* given = std::getenv("SOURCE_DATE_EPOCH");
  const std::time_t time = given == nullptr ? std::time(nullptr) : std::strtoll(given, nullptr, 10);
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(time));
}

std::string capitals(std::string text) {
  for (char& c : text) {
    c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  return text;
}

std::string title(const ProgramUsage& program, const std::string& name,
                  const std::string& summary) {
  return fmt::format(".TH {} 1 {} \"ibmfair {}\" \"ibmfair\"\n.SH NAME\n{} \\- {}\n",
                     roff(capitals(name)), date(), program.version, roff(name), roff(summary));
}

std::string exit_status(const ProgramUsage& program) {
  std::string text = ".SH EXIT STATUS\n";
  for (const ExitCodeUsage& row : program.exit_codes) {
    text += definition(row.code, sentence(row.meaning));
  }
  return text;
}

std::string page_of_program(const ProgramUsage& program) {
  std::string text = title(program, "ibmfair", "fair triangle meshes");
  text +=
      ".SH SYNOPSIS\n\\fBibmfair\\fR \\fICOMMAND\\fR [\\fIARGUMENT\\fR...] [\\fIOPTION\\fR...]\n";
  text += fmt::format(".SH DESCRIPTION\n{}\n.SH COMMANDS\n", roff(program.summary));
  for (const CommandUsage& command : program.commands) {
    text += fmt::format(".TP\n\\fBibmfair\\-{}\\fR(1)\n{}\n", command.name,
                        roff(sentence(command.summary)));
  }
  text += roff_options(program.options) + exit_status(program) + ".SH ENVIRONMENT\n";
  for (const VariableUsage& variable : program.variables) {
    text += definition(variable.name, sentence(variable.meaning));
  }
  std::vector<Example> examples;
  std::string others;
  for (const CommandUsage& command : program.commands) {
    examples.insert(examples.end(), command.examples.begin(), command.examples.end());
    others += fmt::format(".BR ibmfair\\-{} (1){}\n", command.name,
                          &command == &program.commands.back() ? "" : ",");
  }
  return text + roff_examples(examples) + ".SH SEE ALSO\n" + others;
}

std::string page_of_command(const ProgramUsage& program, const CommandUsage& command) {
  std::string text = title(program, "ibmfair-" + command.name, command.summary);
  text += fmt::format(".SH SYNOPSIS\n\\fB{}\\fR\n.SH DESCRIPTION\n{}\n", roff(synopsis_of(command)),
                      roff(sentence(command.summary)));
  for (const OptionUsage& argument : command.arguments) {
    text += fmt::format(".TP\n\\fI{}\\fR\n{}\n", argument.name,
                        roff(sentence(full_help_of(argument, {}))));
  }
  text += roff_options(command.options);
  for (const Section& section : command.sections) {
    text += part(capitals(section.title), verbatim(section.text));
  }
  return text + roff_examples(command.examples) + exit_status(program) +
         ".SH SEE ALSO\n.BR ibmfair (1)\n";
}

}  // namespace

std::string man_page(const ProgramUsage& program, const CommandUsage* command) {
  return command == nullptr ? page_of_program(program) : page_of_command(program, *command);
}

}  // namespace ibmfair::commands
