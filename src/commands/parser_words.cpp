#include "commands/parser_words.h"

#include <array>
#include <regex>

namespace ibmfair::commands {

std::string in_plain_words(const std::string& error) {
  struct Wording {
    std::regex pattern;
    const char* plain;
    bool has_list = false;  // of words that are separated by commas without blanks
  };
  static const std::array<Wording, 8> wordings{{
      {std::regex(R"(^(\S+): (.*) not in \{(.*)\}$)"), "$1: '$2' is not known; write one of $3",
       true},
      {std::regex(R"(^(\S+): 1 required TEXT:\{(.*)\} missing$)"), "$1 needs a value: one of $2",
       true},
      {std::regex(R"(^(\S+): 1 required (\S+) missing$)"), "$1 needs a value: $2"},
      {std::regex(R"(^(\S+) excludes (\S+)$)"), "$1 cannot be combined with $2"},
      {std::regex(R"(^(\S+) requires (\S+)$)"), "$1 needs $2"},
      {std::regex(R"(^(\S+) is required$)"), "the argument $1 is missing"},
      {std::regex(R"(^Could not convert: (\S+) = (.*)$)"), "$1 takes no value, but '$2' is given"},
      {std::regex(R"(^(\S+): At Most 1 required but received (\d+)$)"),
       "$1 is given $2 times; it can be given once"},
  }};
  for (const Wording& wording : wordings) {
    if (std::regex_match(error, wording.pattern)) {
      const std::string text = std::regex_replace(error, wording.pattern, wording.plain);
      return wording.has_list ? std::regex_replace(text, std::regex(","), ", ") : text;
    }
  }
  return error;
}

}  // namespace ibmfair::commands
