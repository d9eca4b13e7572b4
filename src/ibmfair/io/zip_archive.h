// Reads the entries of a zip archive that is in memory (PKWARE's APPNOTE 6.3, with zip64).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "ibmfair/io/source_bytes.h"

namespace ibmfair {

class ZipArchive {
 public:
  /// Reads the directory. Throws BadFile if the bytes are no zip archive or are truncated.
  explicit ZipArchive(const SourceBytes& source);

  /// Whether there is an entry of this name. Upper and lower case are equal, and a slash at the
  /// start is left out, as in names of parts of a package.
  bool has(std::string_view name) const { return find(name) != nullptr; }

  /// The decompressed bytes of an entry, called "ARCHIVE: NAME" in messages. Throws BadFile if
  /// there is no such entry, or if it is damaged, encrypted or compressed by a method other than
  /// deflate; OutOfMemory if it does not fit into the memory.
  std::shared_ptr<const SourceBytes> read(std::string_view name) const;

 private:
  struct Entry {
    std::string name;
    std::uint16_t flags = 0;
    std::uint16_t method = 0;
    std::uint32_t checksum = 0;
    std::uint64_t compressed = 0;  // bytes
    std::uint64_t size = 0;        // bytes
    std::uint64_t header = 0;      // offset of the local header
  };

  const Entry* find(std::string_view name) const;
  void read_directory();
  Entry entry_at(std::uint64_t& offset) const;
  std::string_view stored(const Entry& entry, const std::string& title) const;
  std::string_view piece(std::uint64_t offset, std::uint64_t size) const;
  template <class T>
  T number(std::uint64_t offset) const;

  const SourceBytes& source_;
  std::vector<Entry> entries_;
};

}  // namespace ibmfair
