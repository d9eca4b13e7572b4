// Groups of options that have the same meaning for several commands.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "commands/length.h"
#include "ibmfair/io/mesh_file.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace ibmfair::commands {

class Host;

/// Declares the positional argument IN: a mesh to read.
void add_input_argument(CLI::App& app, std::string& path);

/// Sets the extensions of mesh files that shells offer first for this argument or option.
void offer_meshes_to_read(CLI::App& app, const CLI::Option& option);
void offer_meshes_to_write(CLI::App& app, const CLI::Option& option);

/// How input files are read.
struct InputOptions {
  ReadOptions read;
  std::optional<Length> weld_within = {};  ///< merge vertices that are this close to each other
};

/// Declares --input-format and --weld.
void add_input_options(CLI::App& app, InputOptions& options);

/// Reads a mesh file ("-": standard input), merges its vertices as the options say, and prints
/// remarks to the console.
MeshFile read_input(const std::string& path, const InputOptions& options, const Host& host);

/// Path and format of the mesh to write.
struct OutputOptions {
  std::string path;
  WriteOptions write;
};

/// Declares the positional argument OUT, --format and --precision, but not --overwrite
/// (add_overwrite_option).
void add_output_options(CLI::App& app, OutputOptions& options);

/// Declares --overwrite, which applies to all files that the command writes.
void add_overwrite_option(CLI::App& app, bool& overwrite);

/// Declares --laplacian, which selects a member of the family of energies.
CLI::Option* add_laplacian_option(CLI::App& app, std::string& name, const std::string& help);

/// The mass matrix of the energy.
struct MassOptions {
  std::string name;      ///< from mass_matrices(); empty: the default of the Laplacian
  bool without = false;  ///< --no-mass, the short form of --mass none

  bool mass() const { return !without && name != "none"; }
};

/// Declares --mass.
CLI::Option* add_mass_option(CLI::App& app, std::string& name);

/// Declares --mass and --no-mass.
void add_mass_options(CLI::App& app, MassOptions& options);

/// Declares --strict.
void add_strict_option(CLI::App& app, bool& strict);

/// The destinations of a command's report.
struct ReportOptions {
  bool json = false;                ///< write JSON to standard output
  std::vector<std::string> paths;   ///< files, whose extensions select the format
  std::string option = "--report";  ///< name of the option that takes the paths
};

/// Declares --json and --report.
void add_report_options(CLI::App& app, ReportOptions& options);

/// JSON as printable text (commands/printable.h): text_of() is indented, line_of() is one line.
std::string text_of(const nlohmann::ordered_json& json);
std::string line_of(const nlohmann::ordered_json& json);

}  // namespace ibmfair::commands
