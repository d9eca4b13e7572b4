// One file that all ranks read or write, each its own bytes. All members are collective and throw
// Failure on all ranks where they fail on one.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "petsc_engine/communicator.h"

namespace ibmfair::petsc {

class MpiFile {
 public:
  enum class Mode : std::uint8_t { read, write };

  /// The file exists. `name` is what messages call it.
  MpiFile(const Communicator& comm, const std::string& path, std::string name, Mode mode);
  ~MpiFile();
  MpiFile(const MpiFile&) = delete;
  MpiFile& operator=(const MpiFile&) = delete;

  std::int64_t size() const;

  /// From byte `offset` on; ranks may have different places and numbers of bytes.
  std::string read(std::int64_t offset, std::int64_t count);
  void write(std::int64_t offset, std::string_view bytes);

  /// Bytes first .. last - 1 of another file, to `offset`, each rank its share.
  void copy(MpiFile& from, std::int64_t first, std::int64_t last, std::int64_t offset);

  /// What was written reaches the disk.
  void sync();

 private:
  void require(int code) const;

  const Communicator& comm_;
  std::string name_;
  Mode mode_;
  MPI_File file_ = MPI_FILE_NULL;
};

}  // namespace ibmfair::petsc
