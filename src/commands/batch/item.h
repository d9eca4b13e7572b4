// Items: what a batch runs, one process each.
#pragma once

#include <string>
#include <vector>

#include "commands/batch/job.h"

namespace ibmfair::commands {

struct Item {
  std::size_t number = 0;              ///< in the whole list, counted from 1
  std::string place;                   ///< of its job, as messages start
  std::vector<std::string> words;      ///< the program's arguments
  std::string command, input, output;  ///< the files as the arguments name them; empty: has none
  std::vector<std::string> reads;      ///< all files that its result depends on
  std::vector<std::string> writes;     ///< all files that it makes, the output first
  std::string job;                     ///< JSON, as commands/effective_job.h has it
  bool job_is_exact = true;            ///< false: it lacks bytes that are no UTF-8, see `words`

  bool overwrite = false;        ///< among its options
  bool takes_overwrite = false;  ///< has such an option
  bool takes_json = false;       ///< can tell its figures on standard output
  bool has_threads = false;      ///< among its options

  /// What messages and tables call it: `IN -> OUT`, or what there is of it.
  std::string label() const;
};

/// One item for every input of every job, in order; globs give sorted names, without those that the
/// same job writes. Everything that can be wrong is found before anything runs:
/// throws BadFile for an input that is missing or a glob without matches; BadOption for arguments
/// that the command does not take, for files that two items write or one writes and another reads,
/// for items that would replace their own input, and for standard input or output.
std::vector<Item> expand_jobs(const std::vector<Job>& jobs);

}  // namespace ibmfair::commands
