// The record of a batch: one line of JSON as an item starts and one as it ends, so that a killed
// batch can tell what is done.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "commands/batch/file_state.h"
#include "commands/batch/outcome.h"

namespace ibmfair::commands {

/// What a result was made from, and what it was.
struct Finished {
  struct Input {
    FileStamp stamp;
    std::string hash;
  };
  std::string options;             ///< hash of the effective job
  std::string program;             ///< version
  std::vector<Input> inputs;       ///< in the order of Item::reads
  std::vector<FileStamp> outputs;  ///< in the order of Item::writes
  Outcome outcome;
};

/// What earlier runs have left, in the journals of all parts of the list. A line that a killed run
/// left half-written is ignored.
class JournalRecord {
 public:
  JournalRecord() = default;
  explicit JournalRecord(const std::vector<std::string>& paths);

  /// Whether a run has begun to make this item, so that what it writes is the batch's own.
  bool started(const std::string& key) const { return started_.contains(key); }

  /// What runs have finished with exit code 0.
  const std::vector<Finished>& finished(const std::string& key) const;

 private:
  void read_line(const std::string& line);

  std::set<std::string> started_;
  std::map<std::string, std::vector<Finished>> finished_;
};

/// Appends whole lines to a file that only one batch at a time writes.
class Journal {
 public:
  /// Opens or makes the file. Throws CannotWrite, also where another batch has it open, and where
  /// the name leads to something else: a folder that others can write might turn the batch's own
  /// record against a file that runs what it holds.
  explicit Journal(const std::string& path);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  const std::string& path() const { return path_; }

  /// Notes that from here on what the item writes is the batch's own, under a key for the item.
  void add_start(const std::string& key);

  /// Notes how it ended. The files of one that could not write are not the batch's own.
  void add_end(const std::string& key, const Finished& finished);

 private:
  void append(const std::string& line);

  std::string path_;
  int fd_ = -1;
};

/// The journal of a part of a list that has several, and all that belong to the same list.
std::string journal_of_shard(const std::string& path, std::size_t number, std::size_t count);
std::vector<std::string> journals_of_list(const std::string& path);

}  // namespace ibmfair::commands
