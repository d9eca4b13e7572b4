// Text between the library, for which it is bytes, and Python.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <pybind11/pybind11.h>

namespace ibmfair::python {

/// Bytes that are not UTF-8, as in names of files, become what os.fsdecode makes of them.
inline pybind11::str text_of(std::string_view bytes) {
  return pybind11::reinterpret_steal<pybind11::str>(
      PyUnicode_DecodeUTF8(bytes.data(), static_cast<Py_ssize_t>(bytes.size()), "surrogateescape"));
}

inline pybind11::list texts_of(const std::vector<std::string>& lines) {
  pybind11::list texts;
  for (const std::string& line : lines) {
    texts.append(text_of(line));
  }
  return texts;
}

}  // namespace ibmfair::python
