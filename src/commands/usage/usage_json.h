// The usage as JSON, for programs that call this one: `ibmfair --json-usage`.
#pragma once

#include <string>

#include "commands/usage/usage.h"

namespace ibmfair::commands {

/// Of the program, or of it and one command; `version` changes when the meaning of a field does.
std::string usage_json(const ProgramUsage& program);
std::string usage_json(const ProgramUsage& program, const CommandUsage& command);

}  // namespace ibmfair::commands
