// One file of which each rank reads or writes its own bytes. All members are collective; if a
// member fails on one rank, it throws Failure on all ranks.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "petsc_engine/communicator.h"

namespace ibmfair::petsc {

class MpiFile {
 public:
  enum class Mode : std::uint8_t { read, write };

  /// Opens an existing file. `name` is the name of the file in messages.
  MpiFile(const Communicator& comm, const std::string& path, std::string name, Mode mode);
  ~MpiFile();
  MpiFile(const MpiFile&) = delete;
  MpiFile& operator=(const MpiFile&) = delete;

  std::int64_t size() const;

  /// Read and write bytes from `offset` on; offset and number of bytes may differ between ranks.
  std::string read(std::int64_t offset, std::int64_t count);
  void write(std::int64_t offset, std::string_view bytes);

  /// Copies bytes first .. last - 1 of another file to `offset`; each rank copies a share of them.
  void copy(MpiFile& from, std::int64_t first, std::int64_t last, std::int64_t offset);

  /// Flushes all written bytes to the disk.
  void sync();

 private:
  void require(int code) const;

  const Communicator& comm_;
  std::string name_;
  Mode mode_;
  MPI_File file_ = MPI_FILE_NULL;
};

}  // namespace ibmfair::petsc
