// The record of a batch: one line of JSON as an item starts and one as it ends, so that a killed
// batch can tell what is done.
#pragma once

#include <cstdint>
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
  double time = 0;       ///< when it ended, in seconds since 1970 by the clock of who ran it
  bool refused = false;  ///< it was not even started
};

/// What other runs have left, in the journals of all parts of the list. A line that is half-written
/// is ignored: its run was killed, or is writing it.
class JournalRecord {
 public:
  JournalRecord() = default;
  explicit JournalRecord(const std::vector<std::string>& paths) { read(paths); }

  /// Reads what these journals hold and has not been read yet.
  void read(const std::vector<std::string>& paths);

  /// A record of what comes after all that this one has read.
  JournalRecord continued() const;

  /// Whether a run has begun to make this item, so that what it writes is the batch's own.
  bool started(const std::string& key) const { return started_.contains(key); }

  /// What runs have finished with exit code 0.
  const std::vector<Finished>& finished(const std::string& key) const;

  /// How the last of all runs of it ended, one that was refused included; null where none has ended
  /// or the same journal tells of a later start.
  const Finished* last(const std::string& key) const;

 private:
  void read_line(const std::string& line, const std::string& path);

  struct LastEnd {
    std::string journal;
    Finished finished;
  };

  std::map<std::string, std::int64_t> read_up_to_;        // bytes of each journal
  std::map<std::string, std::set<std::string>> started_;  // which journals say so
  std::map<std::string, std::vector<Finished>> finished_;
  std::map<std::string, LastEnd> last_;
};

/// Appends whole lines to a file that only one batch at a time writes.
class Journal {
 public:
  /// Opens or makes the file. Throws CannotWrite, also where another batch has it open, and where
  /// the name leads to something else: a folder that others can write might turn the batch's own
  /// record against a file that runs what it holds.
  /// With `flushed`, every line is safe, and can be seen by other machines, before the next step.
  explicit Journal(const std::string& path, bool flushed = false);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  const std::string& path() const { return path_; }

  /// Notes that from here on what the item writes is the batch's own, under a key for the item.
  void add_start(const std::string& key);

  /// Notes how it ended. The files of one that could not write are not the batch's own.
  void add_end(const std::string& key, const Finished& finished);

  /// Notes why it was not even started, which says nothing of whose its files are.
  void add_refusal(const std::string& key, const Finished& finished);

 private:
  void append(const std::string& line);
  [[noreturn]] void fail() const;

  std::string path_;
  bool flushed_;
  int fd_ = -1;
};

/// The journal of a part of a list that has several.
std::string journal_of_shard(const std::string& path, std::size_t number, std::size_t count);

/// The folder of processes that run a list together, and the journals that they keep there, sorted.
std::string folder_of_processes(const std::string& path);
std::vector<std::string> journals_of_processes(const std::string& path);

/// All journals that belong to the same list.
std::vector<std::string> journals_of_list(const std::string& path);

}  // namespace ibmfair::commands
