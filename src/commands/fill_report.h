// The report of a run of `fill`: one line per hole for people, JSON for programs.
#pragma once

#include <string>

#include "commands/report/report.h"
#include "ibmfair/fill/fill_holes.h"
#include "ibmfair/fill/fill_region.h"

namespace ibmfair::commands {

/// Wall time of the command's stages.
struct FillSeconds {
  double read = 0, topology = 0, fill = 0, audit = 0, write = 0;
};

/// A table with one line per hole, and the seconds of the stages. If `detailed`, lists all holes
/// and all stages; otherwise only the first holes, and the stages that took long.
std::string fill_text(const Filling& filling, const FillSeconds& seconds, bool detailed);

/// Adds to the report the fields about holes, the table of holes, and warnings about holes that
/// were not filled properly.
void add_filling(const Filling& filling, const std::vector<Hole>& holes, const FillSeconds& seconds,
                 Report& report);

/// A sentence that lists the requested results that were not achieved; empty if there are none.
std::string shortfall(const Filling& filling, bool allow_intersections);

/// Describes the fairing of a region.
std::string region_text(const RegionReport& region, const FillSeconds& seconds, bool detailed);
void add_region(const RegionReport& region, const FillSeconds& seconds, Report& report);

}  // namespace ibmfair::commands
