// An output file that appears complete or not at all.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "ibmfair/io/byte_sink.h"
#include "ibmfair/io/temporary_file.h"

namespace ibmfair {

/// Collects output in a temporary file in the directory of the target; commit() flushes it to the
/// disk and moves it to the target. Without commit() the target stays as it was. If the path is a
/// symbolic link, the file that it names is replaced, or, if that file does not exist, created
/// (with `overwrite` only). An existing file keeps its permissions. Standard output ("-"), devices
/// and pipes are written directly.
///
/// Every member function throws CannotWrite with the target and the reason.
class AtomicFile final : public ByteSink {
 public:
  /// Whether other processes can also write to the temporary file, by its name.
  enum class Sharing : std::uint8_t { none, by_name };

  /// Throws CannotWrite if the file exists and `overwrite` is false, or if the file is
  /// write-protected.
  AtomicFile(const std::string& path, bool overwrite, Sharing sharing = Sharing::none);
  ~AtomicFile() override;

  /// The name of the temporary file if it was opened with Sharing::by_name; empty if the output is
  /// written directly.
  const std::string& shared_name() const { return temporary_.name(); }

  /// Replaces the target by the output. Nothing may be written afterwards.
  void commit();

 private:
  void take(std::string_view bytes) override;
  [[noreturn]] void fail(int error) const;

  std::string name_;    // the name of the target in messages
  std::string target_;  // symbolic links resolved; empty if the output is written directly
  TemporaryFile temporary_;
  bool overwrite_;
  int fd_ = -1;  // descriptor of the file that is written
};

/// Throws the error that writing to `path` would cause at once (it exists, its directory is missing
/// or protected), so that a long computation does not fail only at its end. Devices and pipes are
/// not opened for this test.
void require_writable(const std::string& path, bool overwrite);

}  // namespace ibmfair
