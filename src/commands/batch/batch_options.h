// How a batch is run, whichever way it was written down.
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

/// A part of a list: items number, number + count, number + 2 count, ...
struct Shard {
  std::size_t number = 1;  ///< counted from 1
  std::size_t count = 1;
};

struct BatchOptions {
  int jobs = 1;  ///< items at a time; 0: one a core
  bool fail_fast = false;
  bool resume = false;
  bool dry_run = false;
  bool shared = false;        ///< with other processes that run the same list
  double claim_expiry = 300;  ///< seconds after which one without a sign of life counts for dead
  bool merge = false;         ///< run nothing, tell what the runs of all parts have done
  bool dump_config = false;
  ReportOptions report;    ///< on the whole list
  bool overwrite = false;  ///< outputs and the reports
  int threads = 0;         ///< of every item; 0: its share of the cores
  Shard shard;
  std::string journal;  ///< empty: the default of the list
};

/// --jobs, --keep-going, --fail-fast, --resume, --shard, --shared, --claim-expiry, --merge,
/// --dry-run, --summary, --journal.
std::vector<CLI::Option*> add_batch_options(CLI::App& app, BatchOptions& options);

/// The items of that part. Every item is in one part for any count.
std::vector<Item> items_of_shard(std::vector<Item> items, const Shard& shard);

}  // namespace ibmfair::commands
