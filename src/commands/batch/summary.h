// What a batch tells of its items, line by line and at the end.
#pragma once

#include <string>
#include <vector>

#include "commands/batch/item.h"
#include "commands/batch/outcome.h"
#include "commands/report/report.h"

namespace ibmfair::commands {

/// `[3/12] failed  0.02 s  a.obj -> b.obj: a.obj:7:3: ...`
std::string status_line(const Item& item, const Outcome& outcome, std::size_t total);

/// `3 of 12 done in 1.25 s`
std::string summary_line(const std::vector<Outcome>& outcomes, double seconds);

/// For people: how many items ended how, the time they took, and those that are not done.
std::string summary_table(const std::vector<Item>& items, const std::vector<Outcome>& outcomes);

/// For machines: adds command, input, output, status, exit code, seconds, memory, message and
/// figures of every item, and links to the pages that they have written. As a table it has one line
/// for each, and figures that any item has are columns.
void add_summary(const std::vector<Item>& items, const std::vector<Outcome>& outcomes,
                 double seconds, Report& report);

}  // namespace ibmfair::commands
