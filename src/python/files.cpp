#include <pybind11/stl.h>

#include "arrays.h"
#include "bindings.h"
#include "ibmfair/io/formats.h"

namespace py = pybind11;

namespace ibmfair::python {
namespace {

WriteOptions::Precision precision_of(const std::string& name) {
  return name == "float"    ? WriteOptions::Precision::float32
         : name == "double" ? WriteOptions::Precision::float64
                            : WriteOptions::Precision::keep;
}

py::dict report_of(const WriteReport& written) {
  py::dict report;
  report["patched"] = written.patched;
  report["moved_vertices"] = written.moved_vertices;
  report["bytes"] = written.bytes;
  report["notes"] = written.notes;
  return report;
}

}  // namespace

void bind_files(py::module_& module) {
  py::class_<MeshFile>(module, "MeshFile")
      .def_property_readonly("name", &MeshFile::name)
      .def_property_readonly("format",
                             [](const MeshFile& file) { return std::string(file.format().name); })
      .def_property_readonly("notes", &MeshFile::notes)
      .def_property_readonly("warnings", &MeshFile::warnings)
      .def("positions", [](const MeshFile& file) { return array_of(Points(file.mesh().X)); })
      .def("faces", [](const MeshFile& file) { return faces_of(file.mesh().faces); })
      .def("vertex_mask", &MeshFile::vertex_mask)
      .def("vertex_values", &MeshFile::vertex_values);
  module.def(
      "read",
      [](const std::string& path, const std::string& format, bool weld) {
        const py::gil_scoped_release unlocked;
        return read_mesh(path, {.format = format, .weld = weld});
      },
      py::arg("path"), py::arg("format"), py::arg("weld"));
  module.def(
      "write",
      [](const MeshFile& file, const Array<double>& V, const std::string& path,
         const std::string& format, const std::string& precision, bool overwrite) {
        const Points X = points_of(V);
        WriteReport written;
        {
          const py::gil_scoped_release unlocked;
          written = write_mesh(
              file, X, path,
              {.format = format, .overwrite = overwrite, .precision = precision_of(precision)});
        }
        return report_of(written);
      },
      py::arg("file"), py::arg("V"), py::arg("path"), py::arg("format"), py::arg("precision"),
      py::arg("overwrite"));
  module.def(
      "write_arrays",
      [](const Array<double>& V, const Array<std::int64_t>& first,
         const Array<std::int32_t>& corner, const std::string& path, const std::string& format,
         const std::string& precision, bool overwrite) {
        const Mesh mesh{points_of(V), polygons_of(first, corner)};
        WriteReport written;
        {
          const py::gil_scoped_release unlocked;
          written = write_mesh(
              mesh, path,
              {.format = format, .overwrite = overwrite, .precision = precision_of(precision)});
        }
        return report_of(written);
      },
      py::arg("V"), py::arg("first"), py::arg("corner"), py::arg("path"), py::arg("format"),
      py::arg("precision"), py::arg("overwrite"));
}

}  // namespace ibmfair::python
