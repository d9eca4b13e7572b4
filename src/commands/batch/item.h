// An item is one run of a command, in a process of its own: one job applied to one input.
#pragma once

#include <string>
#include <vector>

#include "commands/batch/job.h"

namespace ibmfair::commands {

struct Item {
  std::size_t number = 0;              ///< position in the whole list, counted from 1
  std::string place;                   ///< Job::place of its job, the start of messages
  std::vector<std::string> words;      ///< arguments of the program
  std::string command, input, output;  ///< the files as named in the arguments; empty: none
  std::vector<std::string> reads;      ///< all files that the result depends on
  std::vector<std::string> writes;     ///< all files that the item writes, the output first
  std::string job;                     ///< JSON, as from commands/effective_job.h
  bool job_is_exact = true;            ///< false: bytes that are not UTF-8 are missing, see `words`

  bool overwrite = false;        ///< --overwrite is among its options
  bool takes_overwrite = false;  ///< the command has an option --overwrite
  bool takes_json = false;       ///< the command has an option --json
  bool has_threads = false;      ///< --threads is among its options

  /// The name of the item in messages and tables: `IN -> OUT`, or IN or OUT alone.
  std::string label() const;
};

/// Returns one item for every input of every job, in order. Globs are replaced by the sorted names
/// that match, without files that the same job writes. All errors in the jobs are found here,
/// before any item runs: throws BadFile for a missing input or a glob without matches; throws
/// BadOption for arguments that the command does not take, for files that two items write or that
/// one item writes and another reads, for items that would replace their own input, and for
/// standard input or output.
std::vector<Item> expand_jobs(const std::vector<Job>& jobs);

}  // namespace ibmfair::commands
