// What a run tells of itself, for whoever reads it afterwards.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "commands/csv.h"
#include "ibmfair/page/scene.h"

namespace CLI {
class App;
}

namespace ibmfair::commands {

/// Something that is not as it should be.
struct Warning {
  std::string text;                      ///< one line without a full stop
  std::optional<ScenePlace> place = {};  ///< where on the mesh
};

/// All that any format of report (report/report_formats.h) is made of.
struct Report {
  /// Starts it with the schema's version, the program's, and the command with all its arguments.
  explicit Report(const CLI::App& command);

  nlohmann::ordered_json figures;  ///< as data/report.schema.json describes them
  std::vector<Warning> warnings;
  std::optional<Table> table;  ///< the figures that make a table; none: all make one line
  /// Other pages that the figures name: where, and which file. A report names them as they are seen
  /// from its own folder.
  std::vector<std::pair<nlohmann::ordered_json::json_pointer, std::string>> pages;
  /// What a page shows beside the figures; not called for other formats. Empty: nothing.
  std::function<std::optional<Scene>()> scene;
};

/// The figures with the warnings, and the pages relative to the folder of a report at `path`.
nlohmann::ordered_json complete_figures(const Report& report, const std::string& path);

/// The places that warnings have, in their order.
std::vector<ScenePlace> places_of(const std::vector<Warning>& warnings);

}  // namespace ibmfair::commands
