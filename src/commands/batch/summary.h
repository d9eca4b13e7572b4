// The lines that a batch prints about its items, and the summary at the end.
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

/// A table for people: number of items and total seconds of each status, and a line for each of the
/// first items that were started but not finished.
std::string summary_table(const std::vector<Item>& items, const std::vector<Outcome>& outcomes);

/// For programs: adds to the report command, input, output, status, exit code, seconds, memory,
/// message and figures of every item, and links to the pages that the items have written. The table
/// of the report has one line per item, and one column for every figure that any item has.
void add_summary(const std::vector<Item>& items, const std::vector<Outcome>& outcomes,
                 double seconds, Report& report);

}  // namespace ibmfair::commands
