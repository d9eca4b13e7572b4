// The laws of the fuzz targets hold for every seed and for every input that ever broke a law.
#include <algorithm>

#include <gtest/gtest.h>

#include "fuzz/targets.h"
#include "support/files.h"

namespace ibmfair::test {
namespace {

namespace fs = std::filesystem;

/// The files of the target's folders, sorted. Only the files of the project are tested here; the
/// other files have tests of their own.
std::vector<fs::path> saved_inputs(const fuzz::Target& target) {
  const std::string own = project_file("tests");
  std::vector<fs::path> files;
  for (const fs::path& folder : fuzz::seed_folders(target)) {
    if (!folder.string().starts_with(own)) continue;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

class FuzzTarget : public testing::TestWithParam<fuzz::Target> {};

TEST_P(FuzzTarget, HoldsForEverySavedInput) {
  const std::vector<fs::path> files = saved_inputs(GetParam());
  ASSERT_FALSE(files.empty());
  for (const fs::path& file : files) {
    SCOPED_TRACE(file);
    EXPECT_NO_THROW(GetParam().run(read_bytes(file)));
  }
}

TEST_P(FuzzTarget, HoldsForSavedInputsCutAnywhere) {
  for (const fs::path& file : saved_inputs(GetParam())) {
    const std::string bytes = read_bytes(file);
    constexpr std::size_t parts = 7;
    for (std::size_t part = 0; part < parts; ++part) {
      const std::string start = bytes.substr(0, bytes.size() * part / parts);
      SCOPED_TRACE(file.string() + ", the first " + std::to_string(start.size()) + " bytes");
      EXPECT_NO_THROW(GetParam().run(start));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, FuzzTarget, testing::ValuesIn(fuzz::targets()),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace ibmfair::test
