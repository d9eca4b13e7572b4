// Tables as comma-separated values (RFC 4180).
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace ibmfair::commands {

struct Table {
  nlohmann::ordered_json columns = nlohmann::ordered_json::object();  ///< only the keys are used
  std::vector<nlohmann::ordered_json> rows;  ///< flat objects; other keys become further columns
};

/// Turns `{"after": {"energy": 1}}` into `{"after.energy": 1}`. Lists are left out.
nlohmann::ordered_json flattened(const nlohmann::ordered_json& object);

/// A line with the names of the columns, and one line for each row. A value that is missing, null
/// or not finite is an empty field.
std::string csv_text(const Table& table);

}  // namespace ibmfair::commands
