// An output file that appears complete or not at all.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "ibmfair/io/byte_sink.h"
#include "ibmfair/io/temporary_file.h"

namespace ibmfair {

/// Collects output in a temporary file in the target's directory; commit() flushes it to the disk
/// and moves it to the target. Without commit() the target stays as it was. A symbolic link is
/// followed, the file that it names is replaced or, with `overwrite` only, made. An existing file
/// keeps its permissions. Standard output ("-"), devices and pipes are written directly.
///
/// Every member throws CannotWrite, naming the target and the reason.
class AtomicFile final : public ByteSink {
 public:
  /// Whether other processes can write to the temporary file, too, by its name.
  enum class Sharing : std::uint8_t { none, by_name };

  /// Refuses an existing file unless `overwrite`, one that is write-protected always.
  AtomicFile(const std::string& path, bool overwrite, Sharing sharing = Sharing::none);
  ~AtomicFile() override;

  /// The temporary file's name with Sharing::by_name; empty where the output is written directly.
  const std::string& shared_name() const { return temporary_.name(); }

  /// Makes the output the target. Nothing may be written afterwards.
  void commit();

 private:
  void take(std::string_view bytes) override;
  [[noreturn]] void fail(int error) const;

  std::string name_;    // as messages name the target
  std::string target_;  // symbolic links resolved; empty where written directly
  TemporaryFile temporary_;
  bool overwrite_;
  int fd_ = -1;  // of what is written to
};

/// Throws what writing to `path` would throw at once (it exists, its directory is missing or
/// protected), so that a long computation need not run into it at its end. Devices and pipes are
/// not opened for that.
void require_writable(const std::string& path, bool overwrite);

}  // namespace ibmfair
