#include "commands/batch/child_report.h"

#include <algorithm>
#include <array>

#include <nlohmann/json.hpp>

#include "commands/csv.h"

namespace ibmfair::commands {

namespace {

using nlohmann::ordered_json;

constexpr std::array<std::string_view, 10> left_out{"version", "program", "command", "arguments",
                                                    "input",   "output",  "file",    "a",
                                                    "options", "seconds"};

/// The text after `label` in the first line that starts with `label`.
std::string after_label(std::string_view text, std::string_view label) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (text.starts_with(label)) {
      return std::string(text.substr(label.size(), end - label.size()));
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return {};
}

}  // namespace

std::string first_message(std::string_view err) {
  for (const std::string_view label : {"ibmfair: error: ", "ibmfair: warning: "}) {
    std::string message = after_label(err, label);
    if (!message.empty()) {
      return message;
    }
  }
  return {};
}

ordered_json main_figures(std::string_view out) {
  ordered_json report = ordered_json::parse(out, nullptr, false);
  if (!report.is_object()) {
    return ordered_json::object();
  }
  for (const std::string_view name : left_out) {
    report.erase(std::string(name));
  }
  const ordered_json flat = flattened(report);
  ordered_json figures = ordered_json::object();
  for (const auto& [name, value] : flat.items()) {
    if (!value.is_null()) {
      figures[name] = value;
    }
  }
  return figures;
}

}  // namespace ibmfair::commands
