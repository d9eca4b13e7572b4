// What a batch tells of its items, line by line and at the end.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "commands/batch/item.h"
#include "commands/batch/outcome.h"

namespace ibmfair::commands {

/// `[3/12] failed  0.02 s  a.obj -> b.obj: a.obj:7:3: ...`
std::string status_line(const Item& item, const Outcome& outcome, std::size_t total);

/// `3 of 12 done in 1.25 s`
std::string summary_line(const std::vector<Outcome>& outcomes, double seconds);

/// For people: how many items ended how, the time they took, and those that are not done.
std::string summary_table(const std::vector<Item>& items, const std::vector<Outcome>& outcomes);

/// For machines: command, input, output, status, exit code, seconds, memory, message and figures of
/// every item.
nlohmann::ordered_json summary_json(const std::vector<Item>& items,
                                    const std::vector<Outcome>& outcomes, double seconds);

/// The same as a table of comma-separated values (RFC 4180), one line an item; figures that any
/// item has are columns.
std::string summary_csv(const std::vector<Item>& items, const std::vector<Outcome>& outcomes);

}  // namespace ibmfair::commands
