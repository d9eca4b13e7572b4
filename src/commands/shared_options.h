// Groups of options that several commands have, and what they mean for every one of them.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "commands/console.h"
#include "ibmfair/io/mesh_file.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace ibmfair::commands {

/// The positional IN: a mesh to read.
void add_input_argument(CLI::App& app, std::string& path);

/// The file names of a mesh that shells offer first for this argument or option.
void offer_meshes_to_read(CLI::App& app, const CLI::Option& option);
void offer_meshes_to_write(CLI::App& app, const CLI::Option& option);

/// How input files are read.
struct InputOptions {
  ReadOptions read;
};

/// --input-format, --weld.
void add_input_options(CLI::App& app, InputOptions& options);

/// Reads a mesh file ("-": standard input) and passes on what the reader has to say.
MeshFile read_input(const std::string& path, const InputOptions& options, const Console& console);

/// Where a mesh is written and how.
struct OutputOptions {
  std::string path;
  WriteOptions write;
};

/// The positional OUT and --format. Whether files may be replaced is add_overwrite_option's.
void add_output_options(CLI::App& app, OutputOptions& options);

/// --overwrite, for everything that the command writes.
void add_overwrite_option(CLI::App& app, bool& overwrite);

/// --laplacian: a member of the family of energies.
CLI::Option* add_laplacian_option(CLI::App& app, std::string& name, const std::string& help);

/// Which mass matrix is in the energy.
struct MassOptions {
  std::string name;      ///< from mass_matrices(); empty: the default of the Laplacian
  bool without = false;  ///< the short form of "none"

  bool mass() const { return !without && name != "none"; }
};

/// --mass.
CLI::Option* add_mass_option(CLI::App& app, std::string& name);

/// --mass and --no-mass.
void add_mass_options(CLI::App& app, MassOptions& options);

/// --strict.
void add_strict_option(CLI::App& app, bool& strict);

/// Where a command's figures go.
struct ReportOptions {
  bool json = false;                ///< on standard output
  std::vector<std::string> paths;   ///< of files, whose endings name the format
  std::string option = "--report";  ///< that names them
};

/// --json, --report.
void add_report_options(CLI::App& app, ReportOptions& options);

/// JSON as text that a terminal shows as it is (commands/printable.h): indented, or in one line.
std::string text_of(const nlohmann::ordered_json& json);
std::string line_of(const nlohmann::ordered_json& json);

}  // namespace ibmfair::commands
