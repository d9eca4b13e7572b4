// What the program prints of meshes that it makes itself.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "support/run_program.h"

namespace ibmfair::test {

/// The JSON that a run prints; the run must succeed and say nothing else.
nlohmann::json figures(const Words& arguments, const RunOptions& options = {});

/// The bytes of a generated shape.
std::string made(const Words& arguments, const std::string& format = "off");

/// What `info` finds of it.
nlohmann::json info_of(const Words& shape);

}  // namespace ibmfair::test
