#include "arrays.h"

#include <memory>
#include <utility>

namespace py = pybind11;

namespace ibmfair::python {
namespace {

/// The array takes the matrix, and frees it with its last reference.
template <class T, class Matrix>
py::array_t<T> owning_array(Matrix matrix) {
  auto owned = std::make_unique<Matrix>(std::move(matrix));
  Matrix& rows = *owned;
  const py::capsule owner(owned.get(), [](void* held) { delete static_cast<Matrix*>(held); });
  owned.release();
  return py::array_t<T>({rows.rows(), rows.cols()}, rows.data(), owner);
}

}  // namespace

Points points_of(const Array<double>& V) {
  return Points::Map(V.data(), V.shape(0), 3);
}

Polygons polygons_of(const Array<std::int64_t>& first, const Array<std::int32_t>& corner) {
  Polygons faces;
  faces.first.assign(first.data(), first.data() + first.size());
  faces.corner.assign(corner.data(), corner.data() + corner.size());
  return faces;
}

py::array_t<double> array_of(Points X) {
  return owning_array<double>(std::move(X));
}

py::array_t<std::int32_t> array_of(Triangles F) {
  return owning_array<std::int32_t>(std::move(F));
}

py::tuple faces_of(const Polygons& faces) {
  return py::make_tuple(array_of(faces.first), array_of(faces.corner));
}

}  // namespace ibmfair::python
