// The options of a batch, both for `ibmfair batch` and for commands that take many files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "commands/batch/item.h"
#include "commands/shared_options.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace ibmfair::commands {

/// A part of the list of items: the items number, number + count, number + 2 count, ...
struct Shard {
  std::size_t number = 1;  ///< counted from 1
  std::size_t count = 1;
};

struct BatchOptions {
  int jobs = 1;  ///< items run at the same time; 0: one per core
  bool fail_fast = false;
  bool resume = false;
  bool dry_run = false;
  bool merge = false;  ///< run nothing, report what the runs of all parts have done
  bool dump_config = false;
  ReportOptions report;    ///< about the whole list
  bool overwrite = false;  ///< may replace outputs and reports
  int threads = 0;         ///< threads of every item; 0: an equal share of the cores
  Shard shard;
  std::string journal;  ///< path; empty: the default path of the list
};

/// Declares --jobs, --fail-fast, --keep-going, --resume, --shard, --merge, --dry-run, --summary,
/// --journal.
std::vector<CLI::Option*> add_batch_options(CLI::App& app, BatchOptions& options);

/// The items of the part `shard`. For any count, every item is in exactly one part.
std::vector<Item> items_of_shard(std::vector<Item> items, const Shard& shard);

}  // namespace ibmfair::commands
