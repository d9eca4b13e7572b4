// The figures that the program prints about meshes that it generates itself.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "support/run_program.h"

namespace ibmfair::test {

/// The JSON that a run prints; the run must succeed and print nothing else.
nlohmann::json figures(const Words& arguments, const RunOptions& options = {});

/// The bytes of a generated shape.
std::string made(const Words& arguments, const std::string& format = "off");

/// The figures that `info` prints about a generated shape.
nlohmann::json info_of(const Words& shape);

}  // namespace ibmfair::test
