// What a command's arguments mean to somebody who does not know the command: which files it reads
// and writes, and how a job file calls them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace ibmfair::commands {

/// The type names by which an argument's declaration says that it names a file. The arguments IN
/// and OUT need none.
inline constexpr const char* file_to_read = "FILE";
inline constexpr const char* name_or_file_to_read = "NAME|FILE";
inline constexpr const char* file_to_write = "OUTFILE";

enum class Role : std::uint8_t {
  value,
  reads,       ///< a file
  might_read,  ///< a file if there is one of that name
  writes
};

Role role_of(const CLI::Option& option);

/// Its name in a job file: `input` and `output` for IN and OUT, other positional arguments in lower
/// case, options without dashes.
std::string key_of(const CLI::Option& option);

/// Whether it takes no value.
bool is_flag(const CLI::Option& option);

/// The first positional argument that names a file to read, and the one that names a file to write;
/// null where the command has none.
CLI::Option* input_argument(CLI::App& command);
CLI::Option* output_argument(CLI::App& command);

/// The argument (`positional`) or the option of that key; null where there is none that a job may
/// set.
const CLI::Option* find_argument(const CLI::App& command, std::string_view key, bool positional);

}  // namespace ibmfair::commands
