// A file that is written in the directory of its target and then replaces the target.
#pragma once

#include <atomic>
#include <string>

namespace ibmfair {

/// A temporary file. On file systems that support files without a name, it has no name until it is
/// complete, so that even a killed process leaves nothing behind. On others, and for the moment in
/// which it replaces another file, its name is `.ibmfair-PROCESS-RANDOM.tmp`.
class TemporaryFile {
 public:
  TemporaryFile() = default;
  /// Closes the file, and removes it unless it has been moved to its target.
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  /// Creates the file for writing only; if `named`, with a name from the start. Returns 0 or the
  /// system's error number.
  int create(const std::string& directory, bool named = false);

  /// The path of the file; empty while it has no name.
  const std::string& name() const { return name_; }

  /// Gives the file the name `target`, which must be in the same directory. An existing file of
  /// that name is replaced only if `overwrite`. Returns 0 or the system's error number.
  int move_to(const std::string& target, bool overwrite);

  /// -1 before `create`.
  int descriptor() const { return fd_; }

 private:
  void choose_name();
  void forget_name();

  std::string directory_;
  std::string name_;
  // The entry in which remove_temporary_files() finds the name.
  std::atomic<const char*>* noted_ = nullptr;
  int fd_ = -1;
};

/// Removes the temporary files of this process that have names. For use just before the process
/// ends; may be called in a signal handler. A removed file is never moved to its target afterwards:
/// its thread waits for the end of the process.
void remove_temporary_files();

}  // namespace ibmfair
