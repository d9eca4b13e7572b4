#include "commands/csv.h"

#include <cmath>

namespace ibmfair::commands {

namespace {

using nlohmann::ordered_json;

std::string csv_field(const ordered_json& value) {
  const bool none =
      value.is_null() || (value.is_number_float() && !std::isfinite(value.get<double>()));
  std::string text = none ? "" : value.is_string() ? value.get<std::string>() : value.dump();
  if (text.find_first_of(",\"\r\n") == std::string::npos) {
    return text;
  }
  std::string quoted = "\"";
  for (const char c : text) {
    quoted.append(c == '"' ? 2 : 1, c);
  }
  return quoted + "\"";
}

void flatten(const ordered_json& object, const std::string& prefix, ordered_json& flat) {
  for (const auto& [key, value] : object.items()) {
    if (value.is_object()) {
      flatten(value, prefix + key + ".", flat);
    } else if (!value.is_array()) {
      flat[prefix + key] = value;
    }
  }
}

/// A line with the value `pick(name)` for each column.
template <class Pick>
std::string csv_line(const ordered_json& columns, const Pick& pick) {
  std::string line;
  bool first = true;
  for (const auto& [name, value] : columns.items()) {
    line += (first ? "" : ",") + csv_field(pick(name));
    first = false;
  }
  return line + "\r\n";
}

}  // namespace

ordered_json flattened(const ordered_json& object) {
  ordered_json flat = ordered_json::object();
  flatten(object, "", flat);
  return flat;
}

std::string csv_text(const Table& table) {
  ordered_json columns = table.columns;
  for (const ordered_json& row : table.rows) {
    columns.update(row);
  }
  std::string text = csv_line(columns, [](const std::string& name) { return ordered_json(name); });
  for (const ordered_json& row : table.rows) {
    text += csv_line(columns, [&](const std::string& name) {
      return row.contains(name) ? row[name] : ordered_json();
    });
  }
  return text;
}

}  // namespace ibmfair::commands
