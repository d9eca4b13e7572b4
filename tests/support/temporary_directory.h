// A directory of a test's own that disappears with it.
#pragma once

#include <filesystem>
#include <string>

namespace ibmfair::test {

class TemporaryDirectory {
 public:
  TemporaryDirectory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// The full name of a file in it, as the program's arguments want it.
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

  /// How many entries it holds: a run that failed must leave as many as it found.
  std::size_t entries() const;

 private:
  std::filesystem::path path_;
};

}  // namespace ibmfair::test
