// Finds a row of a table by its name.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"

namespace ibmfair {

/// The row whose name is `name`. Throws BadOption, which calls the row a `what` and lists the known
/// names, if there is no such row.
template <class Row>
const Row& row_named(std::span<const Row> rows, std::string_view what, std::string_view name) {
  std::string known;
  for (const Row& row : rows) {
    if (row.name == name) {
      return row;
    }
    known += fmt::format("{}{}", known.empty() ? "" : ", ", row.name);
  }
  throw BadOption(fmt::format("unknown {} '{}' (there are {})", what, name, known));
}

}  // namespace ibmfair
