// Tables as comma-separated values (RFC 4180).
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace ibmfair::commands {

struct Table {
  nlohmann::ordered_json columns = nlohmann::ordered_json::object();  ///< only names count
  std::vector<nlohmann::ordered_json> rows;  ///< flat objects; their further names are columns, too
};

/// `{"after": {"energy": 1}}` as `{"after.energy": 1}`, without lists.
nlohmann::ordered_json flattened(const nlohmann::ordered_json& object);

/// A line with the names of the columns and one for each row; a value that a row does not have, is
/// null or not finite is empty.
std::string csv_text(const Table& table);

}  // namespace ibmfair::commands
