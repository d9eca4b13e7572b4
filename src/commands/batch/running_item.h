// An item that is running in a process of its own.
#pragma once

#include <chrono>
#include <memory>
#include <set>
#include <string>

#include "commands/batch/child_process.h"
#include "commands/batch/item.h"
#include "commands/batch/journal.h"
#include "commands/batch/outcome.h"

namespace ibmfair::commands {

struct RunningItem {
  std::size_t index;  // index in the list
  const Item* item;   // must outlive this object
  std::string key;    // key in the journal
  Finished record;
  bool inputs_known = false;  // the inputs did not change until they were hashed
  std::chrono::steady_clock::time_point start = {};
  std::unique_ptr<ChildProcess> process = nullptr;

  /// Starts the process. Throws std::runtime_error if the system cannot start a process.
  void start_process(bool overwrite, int threads);

  /// Seconds since the start of the process.
  double seconds() const;

  /// Waits until the process has ended. If a signal ended the process, removes its temporary files.
  Outcome wait_for_end() const;

  void kill_process() const;

  /// The record of the end for the journal.
  Finished record_of_end(const Outcome& outcome) const;
};

/// The first output of the item that already exists; empty if none exists.
std::string file_in_the_way(const Item& item);

/// The folders that the item writes to.
std::set<std::string> output_folders(const Item& item);

}  // namespace ibmfair::commands
