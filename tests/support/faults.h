// Faults of the operating system that tests inject, and the promises that the program keeps then.
#pragma once

#include <cerrno>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "support/run_program.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {

/// A fault in the calls number `first` to `last` of one kind, counted from the program's `main` on.
/// The kinds are malloc (every function that allocates), open, read, write, flock, fsync, linkat,
/// rename and fchmod.
struct Fault {
  std::string call;
  long first = 0;
  long last = first;
  int error = ENOSPC;             ///< the calls fail with this error
  int signal_number = 0;          ///< instead, this signal is sent before the call
  std::string truncated = {};     ///< instead, this file is cut off before the call
  bool no_unnamed_files = false;  ///< as on file systems without unnamed files
};

/// Whether faults can be injected: not with AddressSanitizer, which has its own allocation.
bool faults_can_be_injected();

/// The variables that `RunOptions::environment` must hold for this fault.
std::vector<std::string> environment_of(const Fault& fault);

/// The number of calls of the fault's kind that a run makes. The run must succeed: calls are
/// counted from 1, so that a fault in call 0 never happens.
long count_calls(const Fault& fault, const Words& words, RunOptions options = {});

/// A run that replaces files in a folder of its own. The folder holds `in.ply` (a sphere with
/// noise), `holed.off`, and the files that the run writes.
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

  /// Checks the promises that hold however the run ended: every target is unchanged or whole, and
  /// whole if the run succeeded; the inputs are unchanged; there are no other files except journals
  /// and temporary files; a run that failed says why.
  void expect_promises(const RunResult& result) const;

  std::size_t count_temporary_files() const;

 private:
  bool is_whole(const std::string& target, const std::string& bytes) const;

  TemporaryDirectory directory_;
  Words words_;
  std::map<std::string, std::string> inputs_;  // bytes of each input, by name
  std::map<std::string, std::string> whole_;   // bytes of each target after a whole run
};

/// One run for every way in which the program writes files.
std::vector<std::unique_ptr<WritingRun>> writing_runs();

}  // namespace ibmfair::test
