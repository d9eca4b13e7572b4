// The outcome of an item.
#pragma once

#include <cstdint>
#include <string>

#include <nlohmann/json.hpp>

namespace ibmfair::commands {

enum class Status : std::uint8_t {
  ok,
  failed,
  skipped,      ///< an earlier run has finished it, and nothing has changed
  interrupted,  ///< was running when a signal stopped the batch
  not_run       ///< was not started
};

/// `ok`, `failed`, `skipped`, `interrupted`, `not run`.
const char* name_of(Status status);

struct Outcome {
  Status status = Status::not_run;
  int exit_code = 0;                ///< 128 + signal number if a signal ended it
  double seconds = 0;               ///< wall time
  double peak_megabytes = 0;        ///< largest memory use
  std::string message;              ///< first error message, or else first warning
  nlohmann::ordered_json figures =  ///< fields of its report, as a flat object
      nlohmann::ordered_json::object();
};

}  // namespace ibmfair::commands
