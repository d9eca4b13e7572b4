// The formats of reports, chosen by the ending of the file's name. A new one is one function and
// one row.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "commands/output_files.h"
#include "commands/report/report.h"
#include "commands/shared_options.h"

namespace ibmfair::commands {

struct ReportFormat {
  std::string_view extension;  ///< with its dot
  void (*require)();           ///< throws BadOption where the program cannot write it; null: it can
  std::string (*text)(const Report& report, const std::string& path);
};

/// That of a file of this name; a name without an ending (as `-`) means the first. Throws BadOption
/// that lists those there are and starts with the name of the `option` that the path comes from.
const ReportFormat& report_format(const std::string& path, const std::string& option = "--report");

/// Whether a file of this name is a page.
bool is_page(const std::string& path);

/// The extensions of all formats, without their dots.
std::vector<std::string> report_extensions();

/// The figures as JSON, line by line.
std::string json_report(const Report& report, const std::string& path);

/// What can be wrong with the reports before the work starts, which also writes the files of
/// `others`, the first of them being the mesh. Throws BadOption where the mesh and a report would
/// both go to standard output, where two of all are one file, and where a report's format is none;
/// CannotWrite where a file exists and must not be replaced.
void check_reports(const ReportOptions& options, const std::vector<OutputFile>& others,
                   bool overwrite);

/// Writes the report where the options want it, each to where it was asked for.
void deliver_report(const ReportOptions& options, bool overwrite, const Report& report);

}  // namespace ibmfair::commands
