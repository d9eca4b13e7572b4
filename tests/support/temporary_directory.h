// A directory for one test, which is removed at the end of the test.
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

  /// The full name of a file in the directory, as an argument of the program.
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

  /// The number of entries of the directory: a run that failed must leave as many as it found.
  std::size_t entries() const;

 private:
  std::filesystem::path path_;
};

}  // namespace ibmfair::test
