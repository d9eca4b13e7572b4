// Faults of the system that the program runs on, and what it promises then.
#pragma once

#include <cerrno>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "support/run_program.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {

/// What happens to the calls number `first` to `last` of one kind, counted from the program's
/// `main` on: malloc (all that allocates), open, read, write, fsync, linkat, rename or fchmod.
struct Fault {
  std::string call;
  long first = 0;
  long last = first;
  int error = ENOSPC;             ///< they fail with this
  int signal_number = 0;          ///< instead, this signal comes before
  std::string truncated = {};     ///< instead, this file is cut off before
  bool no_unnamed_files = false;  ///< as on file systems that cannot hold files without a name
};

/// Whether the program can be run so: not with AddressSanitizer, which has its own allocation.
bool faults_can_be_injected();

/// What `RunOptions::environment` must hold.
std::vector<std::string> environment_of(const Fault& fault);

/// How many calls of the fault's kind a run makes, which must succeed: number 0 never comes.
long count_calls(const Fault& fault, const Words& words, RunOptions options = {});

/// A run that replaces files, in a folder of its own: `in.ply`, a sphere with noise, `holed.off`,
/// and what it writes.
class WritingRun {
 public:
  /// `targets` are the names of the files that the program writes for these words.
  WritingRun(Words words, const std::vector<std::string>& targets);

  const Words& words() const { return words_; }
  /// Whether other processes do the writing.
  bool is_batch() const;
  std::string folder() const { return directory_.path().string(); }

  /// Puts files of other content at the targets and runs the program.
  RunResult run(RunOptions options = {});

  /// Checks what holds however the run ended: every target is as it was or whole, and whole if the
  /// run succeeded; the inputs are as they were; there is nothing else, journals and temporary
  /// files apart; a run that failed says why.
  void expect_promises(const RunResult& result) const;

  std::size_t count_temporary_files() const;

 private:
  bool is_whole(const std::string& target, const std::string& bytes) const;

  TemporaryDirectory directory_;
  Words words_;
  std::map<std::string, std::string> inputs_;  // bytes by name
  std::map<std::string, std::string> whole_;   // those of each target
};

/// One for every way in which the program writes.
std::vector<std::unique_ptr<WritingRun>> writing_runs();

}  // namespace ibmfair::test
