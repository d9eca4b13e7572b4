#include "commands/batch/shell_words.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "commands/printable.h"

namespace ibmfair::commands {

namespace {

bool is_plain(char c) {
  constexpr std::string_view others = "_-./=,:+@%";
  return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
         others.find(c) != std::string_view::npos;
}

/// The form $'...' for words that contain invisible characters.
std::string escaped(std::string_view word) {
  std::string text = "$'";
  while (!word.empty()) {
    const std::size_t length = visible_length(word);
    if (length == 0) {
      text += escaped_byte(word.front());
    } else {
      text.append(word.front() == '\'' || word.front() == '\\' ? "\\" : "")
          .append(word.substr(0, length));
    }
    word.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return text + "'";
}

std::string quoted(const std::string& word) {
  if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) {
    return word;
  }
  if (printable(word) != word) {
    return escaped(word);
  }
  return in_single_quotes(word);
}

}  // namespace

std::string in_single_quotes(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    quoted.append(c == '\'' ? "'\\'" : "") += c;
  }
  return quoted + "'";
}

std::string shell_words(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : " ") + quoted(word);
  }
  return text;
}

}  // namespace ibmfair::commands
