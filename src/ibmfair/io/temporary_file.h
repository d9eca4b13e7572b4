// A file that is written beside its target and then takes its place.
#pragma once

#include <atomic>
#include <string>

namespace ibmfair {

/// Where the file system can hold files without a name, this is one until it is complete, so that
/// not even a killed process leaves anything behind. Elsewhere, and for the moment in which it
/// replaces another file, it is called `.ibmfair-PROCESS-RANDOM.tmp`.
class TemporaryFile {
 public:
  TemporaryFile() = default;
  /// Closes the file, and removes it unless it has been moved to its target.
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  /// Makes the file, for writing only; with a name from the start if `named`. Returns 0 or the
  /// system's error number.
  int create(const std::string& directory, bool named = false);

  /// Empty while it has none.
  const std::string& name() const { return name_; }

  /// Gives the file the name `target`, in the same directory; what has that name is replaced only
  /// if `overwrite`. Returns 0 or the system's error number.
  int move_to(const std::string& target, bool overwrite);

  /// -1 before `create`.
  int descriptor() const { return fd_; }

 private:
  void choose_name();
  void forget_name();

  std::string directory_;
  std::string name_;
  std::atomic<const char*>* noted_ = nullptr;  // where remove_temporary_files finds the name
  int fd_ = -1;
};

/// Removes the files of this process that have names. For a process that ends at once: may be
/// called in a signal handler; a file that is removed so is never moved to its target afterwards,
/// its thread waits for the end.
void remove_temporary_files();

}  // namespace ibmfair
