// The meaning of arguments for code that does not know the command: which arguments name files that
// are read or written, and the keys of the arguments in a job file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace ibmfair::commands {

/// The type names that declare an argument as the name of a file. The arguments IN and OUT need no
/// such type name.
inline constexpr const char* file_to_read = "FILE";
inline constexpr const char* name_or_file_to_read = "NAME|FILE";
inline constexpr const char* file_to_write = "OUTFILE";

enum class Role : std::uint8_t {
  value,
  reads,       ///< names a file that is read
  might_read,  ///< names a file that is read if the file exists
  writes       ///< names a file that is written
};

Role role_of(const CLI::Option& option);

/// The key of an argument in a job file: `input` and `output` for IN and OUT, the name in lower
/// case for other positional arguments, the name without dashes for options.
std::string key_of(const CLI::Option& option);

/// Whether the option takes no value.
bool is_flag(const CLI::Option& option);

/// What the parser gives as the value of a flag that stands alone.
inline constexpr const char* flag_alone = "true";

/// Whether the option is a flag that can also be given with a value: `--weld`, `--weld=1e-6u`.
bool has_optional_value(const CLI::Option& option);

/// The values that were given to the option; none for a flag that stands alone.
std::vector<std::string> given_values(const CLI::Option& option);

/// Whether the command has an argument or option with this name, and it was given.
bool is_given(const CLI::App& command, const std::string& name);

/// The first positional argument that names a file to read, and the first that names a file to
/// write; null if the command has no such argument.
CLI::Option* input_argument(CLI::App& command);
CLI::Option* output_argument(CLI::App& command);

/// The argument (if `positional`) or the option with this key; null if there is none, or if a job
/// must not set it.
const CLI::Option* find_argument(const CLI::App& command, std::string_view key, bool positional);

}  // namespace ibmfair::commands
