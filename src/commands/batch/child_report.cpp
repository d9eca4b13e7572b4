#include "commands/batch/child_report.h"

#include <algorithm>
#include <array>

#include <nlohmann/json.hpp>

namespace ibmfair::commands {

namespace {

using nlohmann::ordered_json;

constexpr std::array<std::string_view, 9> left_out{
    "version", "program", "command", "input", "output", "file", "a", "options", "seconds"};

/// What follows `label` in the first line that starts with it.
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

void flatten(const ordered_json& object, const std::string& prefix, ordered_json& flat) {
  for (const auto& [key, value] : object.items()) {
    if (prefix.empty() && std::find(left_out.begin(), left_out.end(), key) != left_out.end()) {
      continue;
    }
    if (value.is_object()) {
      flatten(value, prefix + key + ".", flat);
    } else if (!value.is_array() && !value.is_null()) {
      flat[prefix + key] = value;
    }
  }
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
  ordered_json flat = ordered_json::object();
  const ordered_json report = ordered_json::parse(out, nullptr, false);
  if (report.is_object()) {
    flatten(report, "", flat);
  }
  return flat;
}

}  // namespace ibmfair::commands
