// The files that an importer gets to see.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>

namespace ibmfair {

/// The main file's bytes, and regular files within the folder that it stands in, to be read.
/// Everything else is refused: writing, and names that lead out of the folder as absolute names,
/// `..` and symbolic links may.
class FolderFiles : public Assimp::IOSystem {
 public:
  /// `path` is the main file's; empty: it has none, and there is no folder. `bytes` must outlive
  /// this. The main file is shown under a name that ends in `.extension`.
  FolderFiles(const std::string& path, const std::string& extension,
              std::span<const std::uint8_t> bytes);
  ~FolderFiles() override;
  FolderFiles(const FolderFiles&) = delete;
  FolderFiles& operator=(const FolderFiles&) = delete;

  /// The folder, opened as a place to look from; negative where there is none.
  int folder() const { return folder_; }

  /// The name by which the importer knows the main file.
  const std::string& main_name() const { return main_name_; }

  /// The first name asked for that leads out of the folder; empty: none.
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
