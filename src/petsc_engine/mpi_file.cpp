#include "petsc_engine/mpi_file.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "petsc_engine/blocks.h"

namespace ibmfair::petsc {
namespace {

constexpr std::int64_t largest_piece = std::int64_t{1} << 26;  // bytes at a time

/// Splits `count` bytes into pieces whose size fits into an int of MPI, and calls
/// step(at, size, status) for each piece until a call fails. The accesses are not collective: if
/// one rank failed in a collective access, the other ranks would wait for it. On a full disk Open
/// MPI returns success, so the status is checked as well.
template <class Step>
int in_pieces(std::int64_t count, const Step& step) {
  int code = MPI_SUCCESS;
  for (std::int64_t at = 0; at < count && code == MPI_SUCCESS; at += largest_piece) {
    const auto size = static_cast<int>(std::min(largest_piece, count - at));
    MPI_Status status;
    code = step(at, size, &status);
    int done = 0;
    if (code == MPI_SUCCESS && MPI_Get_count(&status, MPI_BYTE, &done) == MPI_SUCCESS &&
        done != size) {
      code = MPI_ERR_NO_SPACE;
    }
  }
  return code;
}

}  // namespace

MpiFile::MpiFile(const Communicator& comm, const std::string& path, std::string name, Mode mode)
    : comm_(comm), name_(std::move(name)), mode_(mode) {
  require(MPI_File_open(comm.get(), path.c_str(),
                        mode == Mode::read ? MPI_MODE_RDONLY : MPI_MODE_WRONLY, MPI_INFO_NULL,
                        &file_));
}

MpiFile::~MpiFile() {
  if (file_ != MPI_FILE_NULL) {
    MPI_File_close(&file_);
  }
}

/// Throws Failure on all ranks if `code` is an error on any rank.
void MpiFile::require(int code) const {
  comm_.together([&] {
    if (code == MPI_SUCCESS) {
      return;
    }
    std::array<char, MPI_MAX_ERROR_STRING> text{};
    int length = 0;
    MPI_Error_string(code, text.data(), &length);
    if (mode_ == Mode::read && code == MPI_ERR_NO_SPACE) {
      throw BadFile(fmt::format("{}: became shorter while it was read", name_));
    }
    if (mode_ == Mode::read) {
      throw BadFile(fmt::format("{}: cannot be read: {}", name_, text.data()));
    }
    throw CannotWrite(fmt::format("{}: cannot be written: {}", name_, text.data()));
  });
}

std::int64_t MpiFile::size() const {
  MPI_Offset size = 0;
  require(MPI_File_get_size(file_, &size));
  return size;
}

std::string MpiFile::read(std::int64_t offset, std::int64_t count) {
  std::string bytes(static_cast<std::size_t>(count), '\0');
  require(in_pieces(count, [&](std::int64_t at, int size, MPI_Status* status) {
    return MPI_File_read_at(file_, offset + at, &bytes[at], size, MPI_BYTE, status);
  }));
  return bytes;
}

void MpiFile::write(std::int64_t offset, std::string_view bytes) {
  require(in_pieces(std::ssize(bytes), [&](std::int64_t at, int size, MPI_Status* status) {
    return MPI_File_write_at(file_, offset + at, &bytes[at], size, MPI_BYTE, status);
  }));
}

void MpiFile::copy(MpiFile& from, std::int64_t first, std::int64_t last, std::int64_t offset) {
  for (std::int64_t at = first; at < last; at += largest_piece * comm_.size()) {
    const Blocks shares{std::min(last - at, largest_piece * comm_.size()), comm_.size()};
    const std::int64_t start = at + shares.first(comm_.rank());
    const std::string bytes = from.read(start, shares.count(comm_.rank()));
    write(offset + start - first, bytes);
  }
}

void MpiFile::sync() {
  require(MPI_File_sync(file_));
}

}  // namespace ibmfair::petsc
