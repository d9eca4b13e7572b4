// What became of an item.
#pragma once

#include <cstdint>
#include <string>

#include <nlohmann/json.hpp>

namespace ibmfair::commands {

enum class Status : std::uint8_t {
  ok,
  failed,
  skipped,      ///< done by an earlier run, nothing has changed
  interrupted,  ///< was running when the batch was told to stop
  not_run       ///< its turn did not come
};

/// `ok`, `failed`, `skipped`, `interrupted`, `not run`.
const char* name_of(Status status);

struct Outcome {
  Status status = Status::not_run;
  int exit_code = 0;                ///< 128 + number where a signal ended it
  double seconds = 0;               ///< wall time
  double peak_megabytes = 0;        ///< of memory
  std::string message;              ///< the first line of what went wrong, or of the warnings
  nlohmann::ordered_json figures =  ///< numbers and words of its report by name, flat
      nlohmann::ordered_json::object();
};

}  // namespace ibmfair::commands
