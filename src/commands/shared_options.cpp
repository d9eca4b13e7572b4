#include "commands/shared_options.h"

#include <algorithm>
#include <array>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/argument_roles.h"
#include "commands/documentation.h"
#include "commands/host.h"
#include "commands/printable.h"
#include "commands/report/report_formats.h"
#include "commands/value_list.h"
#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/mass_matrices.h"
#include "ibmfair/io/formats.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair::commands {

namespace {

std::string dumped(const nlohmann::ordered_json& json, int indentation) {
  // Bytes that are not UTF-8, as file names can contain, are replaced, because JSON must be UTF-8.
  return printable_json(
      json.dump(indentation, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

/// The names and extensions of the formats, without the last row, which stands for many others.
struct FormatWords {
  std::vector<std::string> names, extensions;
};

FormatWords format_words(bool to_write) {
  FormatWords words;
  for (const Format& format : formats()) {
    if (to_write ? format.generate != nullptr : &format != &formats().back()) {
      words.names.emplace_back(format.name);
      words.extensions.insert(words.extensions.end(), format.extensions.begin(),
                              format.extensions.end());
    }
  }
  return words;
}

/// The words of --precision, in the order of WriteOptions::Precision.
constexpr std::array precision_words{"keep", "float", "double"};

void add_precision_option(CLI::App& app, WriteOptions::Precision& precision) {
  const auto set = [&precision](const std::string& word) {
    const auto* const at = std::ranges::find(precision_words, word);
    precision = static_cast<WriteOptions::Precision>(at - precision_words.begin());
  };
  app.add_option_function<std::string>(
         "--precision", set,
         "type of the coordinates in PLY files: float (7 digits), double (16 digits), or keep: the "
         "type of the input, but double where float would round the vertices by more than 0.001 "
         "mean edge lengths or 1 % of their moves; files that were not PLY become double")
      ->type_name("TYPE")
      ->check(
          CLI::IsMember(std::vector<std::string>(precision_words.begin(), precision_words.end())))
      ->default_str(precision_words.front());
}

MeshFile welded_within(const Length& length, const MeshFile& file, const Console& console) {
  const Mesh& mesh = file.mesh();
  const double tolerance = length.on(mesh.X, length.unit == Length::Unit::edges
                                                 ? build_topology(mesh.X, triangulate(mesh).F)
                                                 : Topology{});
  const CloseWeld weld(file, tolerance);
  if (weld.merged > 0) {
    console.note(fmt::format("merged {} that lay within {:.6g} of others, {:.3g} away at most",
                             counted(weld.merged, "vertex", "vertices"), tolerance, weld.farthest));
  }
  if (weld.collapsed_edges > 0) {
    console.warning(fmt::format(
        "--weld: {} shorter than the tolerance {:.6g}, and collapsed; with them {} left out "
        "(a smaller LENGTH keeps them)",
        counted(weld.collapsed_edges, "edge was", "edges were"), tolerance,
        counted(weld.collapsed_faces, "face was", "faces were")));
  }
  return weld.file;
}

}  // namespace

void add_input_argument(CLI::App& app, std::string& path) {
  CLI::Option* in = app.add_option("IN", path, "mesh file to read; - is standard input");
  offer_meshes_to_read(app, *in->required());
}

void offer_meshes_to_read(CLI::App& app, const CLI::Option& option) {
  note_of(app, option).extensions = format_words(false).extensions;
}

void offer_meshes_to_write(CLI::App& app, const CLI::Option& option) {
  note_of(app, option).extensions = format_words(true).extensions;
}

void add_input_options(CLI::App& app, InputOptions& options) {
  begin_group(app, groups::input_and_output);
  CLI::Option* format =
      app.add_option("--input-format", options.read.format,
                     "format of the input, if its name has no extension that says so")
          ->type_name("NAME");
  note_of(app, *format).offers = format_words(false).names;
  note_of(app, *format).default_text = "from the file's name and first bytes";
  add_optional_length(
      app, "--weld", Length::Unit::absolute,
      "merge vertices at exactly the same position, or with LENGTH vertices that a chain of steps "
      "of "
      "at most this length joins; of these the first stays, and collapsed faces are left out",
      [&options](std::optional<Length> length) {
        options.read.weld = true;
        options.weld_within = length;
      });
}

MeshFile read_input(const std::string& path, const InputOptions& options, const Host& host) {
  const Console& console = host.console();
  MeshFile file = host.read(path, options.read);
  for (const std::string& note : file.notes()) {
    console.note(note);
  }
  for (const std::string& warning : file.warnings()) {
    console.warning(warning);
  }
  return options.weld_within ? welded_within(*options.weld_within, file, console) : file;
}

void add_output_options(CLI::App& app, OutputOptions& options) {
  begin_group(app, groups::input_and_output);
  CLI::Option* out = app.add_option("OUT", options.path, "mesh file to write; - is standard output")
                         ->type_name(file_to_write);
  offer_meshes_to_write(app, *out->required());
  CLI::Option* format =
      app.add_option("--format", options.write.format,
                     "format of the output, if its name has no extension that says so")
          ->type_name("NAME");
  note_of(app, *format).offers = format_words(true).names;
  note_of(app, *format).default_text = "from the file's name";
  add_precision_option(app, options.write.precision);
}

void add_overwrite_option(CLI::App& app, bool& overwrite) {
  begin_group(app, groups::input_and_output);
  app.add_flag("--overwrite", overwrite, "replace output files that exist");
}

CLI::Option* add_laplacian_option(CLI::App& app, std::string& name, const std::string& help) {
  std::vector<std::string> names;
  std::string list;
  for (const BendingModel& model : bending_models()) {
    names.emplace_back(model.name);
    list += fmt::format("{}\n    {}\n    masses: {}\n", model.name, model.summary,
                        fmt::join(model.masses, ", "));
  }
  documentation_of(app).sections.push_back({"Laplacians", list, true});
  return app.add_option("--laplacian", name, help)
      ->check(CLI::IsMember(names))
      ->capture_default_str();
}

CLI::Option* add_mass_option(CLI::App& app, std::string& name) {
  std::vector<std::string> names;
  for (const MassMatrix& mass : mass_matrices()) {
    names.emplace_back(mass.name);
  }
  CLI::Option* option =
      app.add_option("--mass", name,
                     "mass matrix of the energy; it must be in the Laplacian's list")
          ->check(CLI::IsMember(names));
  note_of(app, *option).default_text =
      "the first in the Laplacian's list; for fill the first that measures area";
  return option;
}

void add_mass_options(CLI::App& app, MassOptions& options) {
  CLI::Option* mass = add_mass_option(app, options.name);
  app.add_flag("--no-mass", options.without,
               "leave the mass matrix out of the energy; short for --mass none")
      ->excludes(mass);
}

void add_strict_option(CLI::App& app, bool& strict) {
  begin_group(app, groups::input_and_output);
  app.add_flag("--strict", strict,
               "fail with exit code 4 if the mesh has defects, instead of printing a warning");
}

void add_report_options(CLI::App& app, ReportOptions& options) {
  begin_group(app, groups::reports_and_pictures);
  app.add_flag("--json", options.json, "write the results as JSON to standard output")
      ->configurable(false);  // a batch adds --json to its jobs itself
  CLI::Option* report =
      app.add_option("--report", options.paths,
                     "also write the results to this file: .html is a page that shows the mesh, "
                     ".json holds all figures, .csv a table; can be given several times")
          ->type_name(file_to_write)
          ->allow_extra_args(false);
  note_of(app, *report).extensions = report_extensions();
}

std::string text_of(const nlohmann::ordered_json& json) {
  return dumped(json, 2) + "\n";
}

std::string line_of(const nlohmann::ordered_json& json) {
  return dumped(json, -1);
}

}  // namespace ibmfair::commands
