// The formats of reports, chosen by the extension of the file name. A new format is one function
// and one row.
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
  void (*require)();           ///< throws BadOption if this build cannot write the format; or null
  std::string (*text)(const Report& report, const std::string& path);
};

/// The format for a file with this name; the first format if the name has no extension (as `-`).
/// Throws BadOption with a message that starts with `option`, the option that the path comes from,
/// and lists all formats.
const ReportFormat& report_format(const std::string& path, const std::string& option = "--report");

/// Whether a file with this name is an HTML page.
bool is_page(const std::string& path);

/// The extensions of all formats, without their dots.
std::vector<std::string> report_extensions();

/// The figures as indented JSON.
std::string json_report(const Report& report, const std::string& path);

/// Checks the reports and the other output files of a run before the work starts; the first of
/// `others` is the mesh. Throws BadOption if both the mesh and a report would go to standard
/// output, if two outputs are the same file, or if the format of a report is unknown. Throws
/// CannotWrite if a file exists and must not be replaced.
void check_reports(const ReportOptions& options, const std::vector<OutputFile>& others,
                   bool overwrite);

/// Writes the report to each of the files in `options`, and to standard output if requested.
void deliver_report(const ReportOptions& options, bool overwrite, const Report& report);

}  // namespace ibmfair::commands
