#include "commands/exit_code.h"

#include <exception>
#include <new>

#include "ibmfair/base/errors.h"

namespace ibmfair::commands {

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
