// The fuzz targets: functions that take any bytes and check a law about them. tools/fuzz feeds them
// what libFuzzer makes up; replay_test.cpp feeds them, in every run of the tests, the seeds and
// every input that ever broke a law.
#pragma once

#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace ibmfair::fuzz {

/// A law that does not hold. Nothing in the library or the program knows it.
class LawBroken : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// Throws LawBroken unless `holds`.
inline void law(bool holds, const std::string& text) {
  if (!holds) throw LawBroken(text);
}

struct Target {
  std::string_view name;
  /// What its inputs are: names of folders in corpus/ and of dictionaries.
  std::vector<std::string_view> kinds;
  /// Returns where the law holds; throws what it does not expect.
  void (*run)(std::string_view bytes);
};

/// All of them.
std::span<const Target> targets();

/// The target of that name; throws std::out_of_range where there is none.
const Target& find_target(std::string_view name);

/// The folders of inputs to begin with: the seeds, what has broken a law before, and the collection
/// of malformed files where it is there (support/files.h).
std::vector<std::filesystem::path> seed_folders(const Target& target);

// The functions of the table, one file each or one a kind of thing.
void read_obj(std::string_view bytes);
void read_ply(std::string_view bytes);
void read_off(std::string_view bytes);
void write(std::string_view bytes);
void command_line(std::string_view bytes);
void batch_files(std::string_view bytes);
void flow(std::string_view bytes);
void fill(std::string_view bytes);

}  // namespace ibmfair::fuzz
