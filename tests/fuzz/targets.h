// The fuzz targets are functions that take any bytes and check a law about them. tools/fuzz runs
// them on inputs that libFuzzer makes up. In every run of the tests, replay_test.cpp runs them on
// the seeds and on every input that ever broke a law.
#pragma once

#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace ibmfair::fuzz {

/// The exception for a law that does not hold. Neither the library nor the program knows it.
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
  /// The kinds of its inputs: names of folders in corpus/ and of dictionaries.
  std::vector<std::string_view> kinds;
  /// Returns if the law holds; otherwise throws LawBroken or an unexpected exception.
  void (*run)(std::string_view bytes);
};

/// All fuzz targets.
std::span<const Target> targets();

/// The target of that name; throws std::out_of_range if there is none.
const Target& find_target(std::string_view name);

/// The folders of the first inputs: the seeds, the inputs that have broken a law before, and the
/// collection of malformed files if it is present (support/files.h).
std::vector<std::filesystem::path> seed_folders(const Target& target);

// The functions of the table of targets; each file has one function, or the functions of one kind.
void read_obj(std::string_view bytes);
void read_ply(std::string_view bytes);
void read_off(std::string_view bytes);
void read_3mf(std::string_view bytes);
void write(std::string_view bytes);
void command_line(std::string_view bytes);
void batch_files(std::string_view bytes);
void flow(std::string_view bytes);
void fill(std::string_view bytes);

}  // namespace ibmfair::fuzz
