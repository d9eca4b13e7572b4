// An item of a list while it runs, in a process of its own.
#pragma once

#include <chrono>
#include <memory>
#include <set>
#include <string>

#include "commands/batch/child_process.h"
#include "commands/batch/claim.h"
#include "commands/batch/item.h"
#include "commands/batch/journal.h"
#include "commands/batch/outcome.h"

namespace ibmfair::commands {

struct RunningItem {
  std::size_t index;  // in the list
  const Item* item;   // outlives this
  std::string key;    // in the journal
  Finished record;
  bool inputs_known = false;               // they did not change while they were hashed
  std::unique_ptr<Claim> claim = nullptr;  // given up after the process has ended
  std::chrono::steady_clock::time_point start = {};
  std::unique_ptr<ChildProcess> process = nullptr;

  /// Throws std::runtime_error where the system refuses to.
  void start_process(bool overwrite, int threads);

  /// Seconds since then.
  double seconds() const;

  /// Waits until the process has ended, and removes what it has left if something ended it.
  Outcome wait_for_end() const;

  void kill_process() const;

  /// What the journal is to know of the end.
  Finished record_of_end(const Outcome& outcome) const;
};

/// The first file that the item would replace without being allowed to; empty: none.
std::string file_in_the_way(const Item& item);

/// The folders that the item writes to.
std::set<std::string> output_folders(const Item& item);

}  // namespace ibmfair::commands
