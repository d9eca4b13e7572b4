#include "commands/exit_code.h"

#include <exception>
#include <new>

#include "ibmfair/base/errors.h"

namespace ibmfair::commands {

Failure describe_current_exception() {
  try {
    throw;
  } catch (const BadOption& error) {
    return {ExitCode::usage, error.what()};
  } catch (const BadFile& error) {
    return {ExitCode::bad_file, error.what()};
  } catch (const BadMesh& error) {
    return {ExitCode::bad_mesh, error.what()};
  } catch (const FactorizationFailed& error) {
    return {ExitCode::bad_mesh, error.what()};
  } catch (const OutOfMemory& error) {
    return {ExitCode::out_of_memory, error.what()};
  } catch (const std::bad_alloc&) {
    return {ExitCode::out_of_memory, "not enough memory for this mesh"};
  } catch (const CannotWrite& error) {
    return {ExitCode::cannot_write, error.what()};
  } catch (const std::exception& error) {
    return {ExitCode::internal_error,
            std::string("internal error, please report it: ") + error.what()};
  } catch (...) {
    return {ExitCode::internal_error, "internal error of unknown kind, please report it"};
  }
}

}  // namespace ibmfair::commands
