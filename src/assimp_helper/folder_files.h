// The files that an importer is allowed to read.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>

namespace ibmfair {

/// Read access to the bytes of the main file and to regular files in the folder of the main file.
/// Everything else is refused: writing, and names that lead out of the folder, for example absolute
/// names, names with `..`, and symbolic links.
class FolderFiles : public Assimp::IOSystem {
 public:
  /// `path` is the path of the main file; if `path` is empty, there is no folder to read from.
  /// `bytes`, the content of the main file, must outlive this object. The importer sees the main
  /// file under a name that ends in `.extension`.
  FolderFiles(const std::string& path, const std::string& extension,
              std::span<const std::uint8_t> bytes);
  ~FolderFiles() override;
  FolderFiles(const FolderFiles&) = delete;
  FolderFiles& operator=(const FolderFiles&) = delete;

  /// The descriptor of the folder, for openat2(); negative if there is no folder.
  int folder() const { return folder_; }

  /// The name by which the importer knows the main file.
  const std::string& main_name() const { return main_name_; }

  /// The first requested name that leads out of the folder; empty if there was no such request.
  const std::string& outside() const { return outside_; }

  bool Exists(const char* name) const override;
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* name, const char* mode) override;
  void Close(Assimp::IOStream* stream) override { delete stream; }
  bool CreateDirectory(const std::string& /*name*/) override { return false; }
  bool ChangeDirectory(const std::string& /*name*/) override { return false; }
  bool DeleteFile(const std::string& /*name*/) override { return false; }

 private:
  int open_beneath(const char* name) const;

  std::string main_name_;
  std::span<const std::uint8_t> bytes_;
  int folder_ = -1;
  mutable std::string outside_;
};

}  // namespace ibmfair
