// Conversion between numpy's arrays and the library's types. The Python side of the package
// (ibmfair/_arrays.py) has checked shapes, numbers and vertex numbers before.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <pybind11/numpy.h>

#include "ibmfair/base/types.h"
#include "ibmfair/mesh/mesh.h"

namespace ibmfair::python {

template <class T>
using Array = pybind11::array_t<T, pybind11::array::c_style>;

template <class T>
std::span<const T> span_of(const Array<T>& array) {
  return {array.data(), static_cast<std::size_t>(array.size())};
}

/// Positions, #V x 3.
Points points_of(const Array<double>& V);

/// Faces: face f has the corners first[f] .. first[f + 1] - 1.
Polygons polygons_of(const Array<std::int64_t>& first, const Array<std::int32_t>& corner);

/// An array that owns the rows. No copy is made.
pybind11::array_t<double> array_of(Points X);
pybind11::array_t<std::int32_t> array_of(Triangles F);

template <class T>
pybind11::array_t<T> array_of(const std::vector<T>& values) {
  return pybind11::array_t<T>(static_cast<pybind11::ssize_t>(values.size()), values.data());
}

/// The pair (first, corner).
pybind11::tuple faces_of(const Polygons& faces);

}  // namespace ibmfair::python
