#include "commands/report/report.h"

#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands/effective_job.h"
#include "commands/output_files.h"
#include "ibmfair/base/version.h"

namespace ibmfair::commands {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// Must be increased when the meaning of a field changes.
constexpr int report_version = 1;

ordered_json warnings_json(const std::vector<Warning>& warnings) {
  ordered_json list = ordered_json::array();
  int places = 0;
  for (const Warning& warning : warnings) {
    list.push_back({{"text", warning.text}});
    if (warning.place) {
      const Vec3& at = warning.place->at;
      list.back()["place"] = places++;
      list.back()["element"] = warning.place->title;
      list.back()["at"] = {at[0], at[1], at[2]};
      list.back()["radius"] = warning.place->radius;
    }
  }
  return list;
}

std::string seen_from_folder_of(const std::string& path, const std::string& page) {
  const fs::path folder =
      path == "-" ? fs::path(file_identity(".")) : fs::path(file_identity(path)).parent_path();
  return fs::path(file_identity(page)).lexically_relative(folder).string();
}

}  // namespace

Report::Report(const CLI::App& command)
    : figures{{"version", report_version},
              {"program", fmt::format("ibmfair {}", version())},
              {"command", command.get_name()},
              {"components", ordered_json::array()},
              {"arguments", options_in_force(command)}} {
  add_components(component_versions());
}

void Report::add_components(const std::vector<Component>& components) {
  for (const Component& component : components) {
    figures["components"].push_back({{"name", component.name}, {"version", component.version}});
  }
}

ordered_json complete_figures(const Report& report, const std::string& path) {
  ordered_json figures = report.figures;
  for (const auto& [pointer, page] : report.pages) {
    figures[pointer] = seen_from_folder_of(path, page);
  }
  figures["warnings"] = warnings_json(report.warnings);
  return figures;
}

std::vector<ScenePlace> places_of(const std::vector<Warning>& warnings) {
  std::vector<ScenePlace> places;
  for (const Warning& warning : warnings) {
    if (warning.place) {
      places.push_back(*warning.place);
    }
  }
  return places;
}

}  // namespace ibmfair::commands
