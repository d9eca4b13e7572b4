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

ExitCode tell_of_current_exception(const Console& console) {
  const auto tell = [&console](ExitCode code, const char* message) {
    console.error(message);
    return code;
  };
  try {
    throw;
  } catch (const BadOption& error) {
    return tell(ExitCode::usage, error.what());
  } catch (const BadFile& error) {
    return tell(ExitCode::bad_file, error.what());
  } catch (const BadMesh& error) {
    return tell(ExitCode::bad_mesh, error.what());
  } catch (const FactorizationFailed& error) {
    return tell(ExitCode::bad_mesh, error.what());
  } catch (const OutOfMemory& error) {
    return tell(ExitCode::out_of_memory, error.what());
  } catch (const std::bad_alloc&) {
    return tell(ExitCode::out_of_memory, "not enough memory for this mesh");
  } catch (const CannotWrite& error) {
    return tell(ExitCode::cannot_write, error.what());
  } catch (const std::exception& error) {
    console.error("internal error, please report it:");
    return tell(ExitCode::internal_error, error.what());
  } catch (...) {
    return tell(ExitCode::internal_error, "internal error of unknown kind, please report it");
  }
}

}  // namespace ibmfair::commands
