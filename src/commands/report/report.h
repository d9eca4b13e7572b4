// The report of a run, independent of its format.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "commands/csv.h"
#include "ibmfair/base/version.h"
#include "ibmfair/page/scene.h"

namespace CLI {
class App;
}

namespace ibmfair::commands {

/// A warning about the mesh or about the result.
struct Warning {
  std::string text;                      ///< one line without a full stop
  std::optional<ScenePlace> place = {};  ///< place on the mesh
};

/// The data from which all formats of a report (report/report_formats.h) are made.
struct Report {
  /// Fills in the versions of the schema, the program and its components, and the command with all
  /// its arguments.
  explicit Report(const CLI::App& command);

  /// Adds libraries that the run has loaded to the program's components.
  void add_components(const std::vector<Component>& components);

  nlohmann::ordered_json figures;  ///< described by data/report.schema.json
  std::vector<Warning> warnings;
  std::optional<Table> table;  ///< for CSV; none: all figures in one row
  /// Links to other pages: the position of the link in the figures, and the path of the page. A
  /// report contains the paths relative to its own folder.
  std::vector<std::pair<nlohmann::ordered_json::json_pointer, std::string>> pages;
  /// Makes the scene that an HTML page shows beside the figures; not called for other formats. May
  /// be empty.
  std::function<std::optional<Scene>()> scene;
};

/// The figures with the warnings and with the links to pages relative to the folder of `path`, the
/// path of the report.
nlohmann::ordered_json complete_figures(const Report& report, const std::string& path);

/// The places of the warnings that have one, in the order of the warnings.
std::vector<ScenePlace> places_of(const std::vector<Warning>& warnings);

}  // namespace ibmfair::commands
