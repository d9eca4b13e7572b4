// The parts of the extension module `ibmfair._core`. Each function adds one part to the module.
#pragma once

#include <pybind11/pybind11.h>

namespace ibmfair::python {

/// The library's exceptions become those of `ibmfair.errors`.
void bind_errors(pybind11::module_& module);

/// Commands that run on arrays.
void bind_commands(pybind11::module_& module);

/// The flow, one step at a time.
void bind_flow(pybind11::module_& module);

/// Energies, gradients, Laplacians and mass matrices.
void bind_energies(pybind11::module_& module);

/// Mesh files with all that they hold.
void bind_files(pybind11::module_& module);

}  // namespace ibmfair::python
