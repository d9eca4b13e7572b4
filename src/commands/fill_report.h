// What `fill` tells of a run: a line a hole for people, JSON for programs.
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

/// A table with a line for each hole: all of them and all stages with `detailed`, else the first
/// few and those that took long.
std::string fill_text(const Filling& filling, const FillSeconds& seconds, bool detailed);

/// Adds the fields that the holes fill, the holes as a table, and warnings of those that were not
/// filled as they should.
void add_filling(const Filling& filling, const std::vector<Hole>& holes, const FillSeconds& seconds,
                 Report& report);

/// Describes the fairing of a region.
std::string region_text(const RegionReport& region, const FillSeconds& seconds, bool detailed);
void add_region(const RegionReport& region, const FillSeconds& seconds, Report& report);

}  // namespace ibmfair::commands
