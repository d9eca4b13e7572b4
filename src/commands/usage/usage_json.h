// The usage as JSON, for programs that call this one: `ibmfair --json-usage`.
#pragma once

#include <string>

#include "commands/usage/usage.h"

namespace ibmfair::commands {

/// The usage of the program, or of the program and one command. The field `version` changes when
/// the meaning of a field changes.
std::string usage_json(const ProgramUsage& program);
std::string usage_json(const ProgramUsage& program, const CommandUsage& command);

}  // namespace ibmfair::commands
