#include "commands/report/reading.h"

namespace ibmfair::commands {

void add_reading(const MeshFile& file, Report& report) {
  for (const std::string& warning : file.warnings()) {
    report.warnings.push_back({warning});
  }
  const UnknownStatements& unknown = file.unknown_statements();
  if (unknown.count > 0) {
    report.figures["unknown_statements"] = {
        {"count", unknown.count}, {"first_line", unknown.line}, {"first_keyword", unknown.keyword}};
  }
}

}  // namespace ibmfair::commands
