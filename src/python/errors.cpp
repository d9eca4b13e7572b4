#include "ibmfair/base/errors.h"

#include <new>

#include "bindings.h"
#include "text.h"

namespace py = pybind11;

namespace ibmfair::python {
namespace {

void raise(const char* name, const char* text) {
  const py::object type = py::module_::import("ibmfair.errors").attr(name);
  PyErr_SetObject(type.ptr(), text_of(text).ptr());
}

}  // namespace

void bind_errors(py::module_& /*module*/) {
  py::register_exception_translator([](std::exception_ptr pending) {
    try {
      std::rethrow_exception(pending);
    } catch (const BadOption& error) {
      raise("BadOption", error.what());
    } catch (const BadFile& error) {
      raise("BadFile", error.what());
    } catch (const BadMesh& error) {
      raise("BadMesh", error.what());
    } catch (const FactorizationFailed& error) {
      raise("FactorizationFailed", error.what());
    } catch (const OutOfMemory& error) {
      raise("OutOfMemory", error.what());
    } catch (const std::bad_alloc&) {
      raise("OutOfMemory", "out of memory");
    } catch (const CannotWrite& error) {
      raise("CannotWrite", error.what());
    } catch (const Error& error) {
      raise("Error", error.what());
    }
  });
}

}  // namespace ibmfair::python
