// The journal of a batch has one line of JSON for the start and one for the end of each item, so
// that a batch that was killed can be resumed.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "commands/batch/file_state.h"
#include "commands/batch/outcome.h"

namespace ibmfair::commands {

/// Record of an item that has ended: from what its result was made, and the result.
struct Finished {
  struct Input {
    FileStamp stamp;
    std::string hash;
  };
  std::string options;             ///< hash of the effective job
  std::string program;             ///< version of the program
  std::vector<Input> inputs;       ///< in the order of Item::reads
  std::vector<FileStamp> outputs;  ///< in the order of Item::writes
  Outcome outcome;
  double time = 0;  ///< time of the end, seconds since 1970 by the clock of that machine
};

/// The records of other runs, from the journals of all parts of the list. An incomplete line is
/// ignored: the run that wrote the line was killed, or is still writing.
class JournalRecord {
 public:
  JournalRecord() = default;
  /// Reads the journals at these paths.
  explicit JournalRecord(const std::vector<std::string>& paths);

  /// Whether a run has started this item, so that the batch owns the files that the item writes and
  /// may replace them.
  bool started(const std::string& key) const { return started_.contains(key); }

  /// The records of the runs of this item that ended with exit code 0.
  const std::vector<Finished>& finished(const std::string& key) const;

  /// The record of the last run of this item, which may be a refused one; null if no run has ended,
  /// or if the same journal records a later start.
  const Finished* last(const std::string& key) const;

 private:
  void read_line(const std::string& line, const std::string& path);

  struct LastEnd {
    std::string journal;
    Finished finished;
  };

  std::map<std::string, std::set<std::string>> started_;  // key to journals that record a start
  std::map<std::string, std::vector<Finished>> finished_;
  std::map<std::string, LastEnd> last_;
};

/// Appends whole lines to a journal file. Every line is on the disk before the next step, so that a
/// machine that fails loses no record of an output that is on the disk. Only one run at a time
/// can write to the file (journal_lock.h).
class Journal {
 public:
  /// Opens or makes the file, and locks it until this object is destroyed or the process ends.
  /// Throws BadOption if another run holds the lock. Throws CannotWrite if the file cannot be
  /// written, also if it is not a journal: in a folder that others can write, a link could make the
  /// batch append its record to a file whose content is executed.
  explicit Journal(const std::string& path);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Whether the lock is held; false if the file system has no locks.
  bool locked() const { return locked_; }

  /// Records the start of the item with this key. From here on the batch owns the files that the
  /// item writes.
  void add_start(const std::string& key);

  /// Records how the item ended. The files of an item that could not write do not belong to the
  /// batch.
  void add_end(const std::string& key, const Finished& finished);

  /// Records why the item was not started. This does not change which files the batch owns.
  void add_refusal(const std::string& key, const Finished& finished);

 private:
  void append(const std::string& line);
  [[noreturn]] void fail() const;

  std::string path_;
  int fd_ = -1;
  bool locked_ = false;
};

/// The path of the journal of part `number` of `count`, if `path` is the journal of the whole list.
std::string journal_of_shard(const std::string& path, std::size_t number, std::size_t count);

/// The paths of all journals that belong to the list with the journal `path`.
std::vector<std::string> journals_of_list(const std::string& path);

}  // namespace ibmfair::commands
