#include "commands/report/report_formats.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands/console.h"
#include "commands/csv.h"
#include "commands/page/page.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/io/atomic_file.h"

namespace ibmfair::commands {

namespace {

std::string csv_report(const Report& report, const std::string& path) {
  return csv_text(report.table ? *report.table
                               : Table{{}, {flattened(complete_figures(report, path))}});
}

std::string page_report(const Report& report, const std::string& path) {
  return page_text(complete_figures(report, path), report.scene ? report.scene() : std::nullopt);
}

constexpr std::string_view page_extension = ".html";

constexpr std::array format_rows{
    ReportFormat{".json", nullptr, json_report},
    ReportFormat{".csv", nullptr, csv_report},
    ReportFormat{page_extension, require_page, page_report},
};

std::string extension_of(const std::string& path) {
  return CLI::detail::to_lower(std::filesystem::path(path).extension().string());
}

}  // namespace

const ReportFormat& report_format(const std::string& path, const std::string& option) {
  const std::string extension = extension_of(path);
  const auto* const row = std::find_if(
      format_rows.begin(), format_rows.end(),
      [&](const auto& format) { return extension.empty() || format.extension == extension; });
  if (row == format_rows.end()) {
    throw BadOption(fmt::format("{}: '{}' must end in one of .{}", option, path,
                                fmt::join(report_extensions(), ", .")));
  }
  return *row;
}

bool is_page(const std::string& path) {
  return extension_of(path) == page_extension;
}

std::vector<std::string> report_extensions() {
  std::vector<std::string> extensions;
  extensions.reserve(format_rows.size());
  for (const ReportFormat& format : format_rows) {
    extensions.emplace_back(format.extension.substr(1));
  }
  return extensions;
}

std::string json_report(const Report& report, const std::string& path) {
  return text_of(complete_figures(report, path));
}

void check_reports(const ReportOptions& options, const std::vector<OutputFile>& others,
                   bool overwrite) {
  const bool to_standard_output =
      options.json ||
      std::find(options.paths.begin(), options.paths.end(), "-") != options.paths.end();
  if (!others.empty() && others.front().path == "-" && to_standard_output) {
    throw BadOption(
        "standard output cannot take both the mesh (OUT is -) and the report; --report FILE "
        "writes the report to a file");
  }
  std::vector<OutputFile> files = others;
  for (const std::string& path : options.paths) {
    const ReportFormat& format = report_format(path, options.option);
    if (format.require != nullptr) {
      format.require();
    }
    files.push_back({options.option, path});
  }
  check_output_files(files, overwrite);
}

void deliver_report(const ReportOptions& options, bool overwrite, const Report& report) {
  for (const std::string& path : options.paths) {
    AtomicFile file(path, overwrite);
    file.write(report_format(path).text(report, path));
    file.commit();
  }
  if (options.json) {
    write_standard_output(json_report(report, "-"));
  }
}

}  // namespace ibmfair::commands
