#include "commands/batch/name_pattern.h"

#include <filesystem>
#include <vector>

#include <fmt/format.h>

#include "commands/suggest.h"
#include "ibmfair/base/errors.h"

namespace ibmfair::commands {

namespace {

std::string part_of(const std::filesystem::path& input, const std::string& part,
                    std::string_view pattern) {
  if (part == "name") {
    return input.filename().string();
  }
  if (part == "stem") {
    return input.stem().string();
  }
  if (part == "ext") {
    const std::string extension = input.extension().string();
    return extension.empty() ? extension : extension.substr(1);
  }
  if (part == "dir") {
    return input.has_parent_path() ? input.parent_path().string() : ".";
  }
  throw BadOption(
      fmt::format("'{}': unknown placeholder '{{{}}}'{} (there are {{name}}, {{stem}}, "
                  "{{ext}} and {{dir}}; {{{{ is a brace)",
                  pattern, part, suggestion(part, {"name", "stem", "ext", "dir"})));
}

}  // namespace

std::string expand_pattern(std::string_view pattern, const std::string& input) {
  std::string text;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    const char c = pattern[i];
    const bool twice = i + 1 < pattern.size() && pattern[i + 1] == c;
    if ((c != '{' && c != '}') || twice) {
      text += c;
      i += c == '{' || c == '}' ? 1 : 0;
      continue;
    }
    const std::size_t end = pattern.find('}', i);
    if (c == '}' || end == std::string_view::npos) {
      throw BadOption(
          fmt::format("'{}': a brace without its partner; {{{{ and }}}} are braces", pattern));
    }
    const std::string part(pattern.substr(i + 1, end - i - 1));
    if (input.empty()) {
      throw BadOption(fmt::format("'{}': there is no input to take {{{}}} from", pattern, part));
    }
    text += part_of(input, part, pattern);
    i = end;
  }
  if (text.ends_with('/') && !input.empty()) {
    text += std::filesystem::path(input).filename().string();
  }
  return text;
}

std::string literal_pattern(std::string_view text) {
  std::string pattern;
  for (const char c : text) {
    pattern.append(c == '{' || c == '}' ? 2 : 1, c);
  }
  return pattern;
}

}  // namespace ibmfair::commands
