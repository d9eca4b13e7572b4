#include <pybind11/stl.h>

#include "arrays.h"
#include "bindings.h"
#include "ibmfair/io/formats.h"
#include "ibmfair/io/mesh_in_memory.h"
#include "interpreter_lock.h"
#include "text.h"

namespace py = pybind11;

namespace ibmfair::python {
namespace {

WriteOptions options_of(const std::string& format, const std::string& precision, bool overwrite) {
  WriteOptions options{.format = format, .overwrite = overwrite};
  options.precision = precision == "float"    ? WriteOptions::Precision::float32
                      : precision == "double" ? WriteOptions::Precision::float64
                                              : WriteOptions::Precision::keep;
  return options;
}

/// What `write`, called without the interpreter's lock, reports.
template <class Write>
py::dict report_of(const Write& write) {
  WriteReport written;
  {
    const Unlocked unlocked;
    written = write();
  }
  py::dict report;
  report["patched"] = written.patched;
  report["moved_vertices"] = written.moved_vertices;
  report["bytes"] = written.bytes;
  report["notes"] = texts_of(written.notes);
  return report;
}

}  // namespace

void bind_files(py::module_& module) {
  py::class_<MeshFile>(module, "MeshFile")
      .def_property_readonly("name", [](const MeshFile& file) { return text_of(file.name()); })
      .def_property_readonly("format",
                             [](const MeshFile& file) { return std::string(file.format().name); })
      .def_property_readonly("notes", [](const MeshFile& file) { return texts_of(file.notes()); })
      .def_property_readonly("warnings",
                             [](const MeshFile& file) { return texts_of(file.warnings()); })
      .def("positions", [](const MeshFile& file) { return array_of(Points(file.mesh().X)); })
      .def("faces", [](const MeshFile& file) { return faces_of(file.mesh().faces); })
      .def("vertex_mask", &MeshFile::vertex_mask)
      .def("vertex_values", &MeshFile::vertex_values)
      .def("with_positions",
           [](const MeshFile& file, const Array<double>& V) {
             return file.with_positions(points_of(V));
           })
      .def("with_values", [](const MeshFile& file, std::string name, const Array<double>& values) {
        return file.with_values(std::move(name), {values.data(), values.data() + values.size()});
      });
  module.def("mesh_file", [](const std::string& name, const Array<double>& V,
                             const Array<std::int64_t>& first, const Array<std::int32_t>& corner) {
    const Unlocked unlocked;
    return mesh_in_memory(name, {span_of(V), span_of(first), span_of(corner)});
  });
  module.def(
      "read",
      [](const std::string& path, const std::string& format, bool weld) {
        const Unlocked unlocked;
        return read_mesh(path, {.format = format, .weld = weld});
      },
      py::arg("path"), py::arg("format"), py::arg("weld"));
  module.def(
      "write",
      [](const MeshFile& file, const Array<double>& V, const std::string& path,
         const std::string& format, const std::string& precision, bool overwrite) {
        const Points X = points_of(V);
        const WriteOptions options = options_of(format, precision, overwrite);
        return report_of([&] { return write_mesh(file, X, path, options); });
      },
      py::arg("file"), py::arg("V"), py::arg("path"), py::arg("format"), py::arg("precision"),
      py::arg("overwrite"));
  module.def(
      "write_arrays",
      [](const Array<double>& V, const Array<std::int64_t>& first,
         const Array<std::int32_t>& corner, const std::string& path, const std::string& format,
         const std::string& precision, bool overwrite) {
        const Mesh mesh{points_of(V), polygons_of(first, corner)};
        const WriteOptions options = options_of(format, precision, overwrite);
        return report_of([&] { return write_mesh(mesh, path, options); });
      },
      py::arg("V"), py::arg("first"), py::arg("corner"), py::arg("path"), py::arg("format"),
      py::arg("precision"), py::arg("overwrite"));
}

}  // namespace ibmfair::python
