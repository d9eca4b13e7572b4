#include "commands/exit_code.h"

#include <array>
#include <exception>
#include <new>

#include "ibmfair/base/errors.h"

namespace ibmfair::commands {

std::span<const ExitCodeMeaning> exit_code_meanings() {
  static constexpr std::array table{
      ExitCodeMeaning{"0", "done"},
      ExitCodeMeaning{"1", "ran, but did not reach what was asked"},
      ExitCodeMeaning{"2", "an option or argument that cannot be used"},
      ExitCodeMeaning{"3",
                      "an input that cannot be read or is malformed; the message names file, "
                      "line and column, or element and byte"},
      ExitCodeMeaning{"4", "geometry that cannot be processed"},
      ExitCodeMeaning{"5", "out of memory"},
      ExitCodeMeaning{"6", "an output cannot be written"},
      ExitCodeMeaning{"70", "a mistake in the program itself"},
      ExitCodeMeaning{"128 + n", "ended by signal n: 130 for Ctrl-C, 143 for SIGTERM"},
  };
  return table;
}

ExitCode exit_code_of_current_exception() {
  try {
    throw;
  } catch (const BadOption&) {
    return ExitCode::usage;
  } catch (const BadFile&) {
    return ExitCode::bad_file;
  } catch (const BadMesh&) {
    return ExitCode::bad_mesh;
  } catch (const FactorizationFailed&) {
    return ExitCode::bad_mesh;
  } catch (const OutOfMemory&) {
    return ExitCode::out_of_memory;
  } catch (const std::bad_alloc&) {
    return ExitCode::out_of_memory;
  } catch (const CannotWrite&) {
    return ExitCode::cannot_write;
  } catch (...) {
    return ExitCode::internal_error;
  }
}

ExitCode print_current_exception(const Console& console) {
  const ExitCode code = exit_code_of_current_exception();
  try {
    throw;
  } catch (const std::bad_alloc&) {
    console.error("not enough memory for this mesh");
  } catch (const std::exception& error) {
    if (code == ExitCode::internal_error) {
      console.error("internal error, please report it:");
    }
    console.error(error.what());
  } catch (...) {
    console.error("internal error of unknown kind, please report it");
  }
  return code;
}

}  // namespace ibmfair::commands
