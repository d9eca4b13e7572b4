#include "support/mesh_io.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/io/formats.h"
#include "ibmfair/io/source_bytes.h"
#include "support/files.h"

namespace ibmfair::test {

MeshFile MeshFiles::read(std::string_view bytes, const std::string& name, ReadOptions options) {
  if (options.format.empty()) options.format = path_extension(name);
  return read_mesh(SourceBytes::from_memory(name, bytes), options);
}

std::string MeshFiles::write(const MeshFile& file, const Points& X, const std::string& name,
                             WriteOptions options, WriteReport* report) {
  options.overwrite = true;
  const WriteReport result = write_mesh(file, X, path(name), options);
  if (report != nullptr) *report = result;
  return read_bytes(path(name));
}

std::string MeshFiles::write(const MeshFile& file, const Points& X, const Extension& extension,
                             const std::string& name, WriteOptions options, WriteReport* report) {
  options.overwrite = true;
  const WriteReport result = write_mesh(file, X, extension, path(name), options);
  if (report != nullptr) *report = result;
  return read_bytes(path(name));
}

std::string read_error(std::string_view bytes, const std::string& name) {
  try {
    MeshFiles::read(bytes, name);
  } catch (const BadFile& error) {
    return error.what();
  }
  ADD_FAILURE() << "read without an error: " << bytes.substr(0, 200);
  return {};
}

MeshFile expect_carried(std::string_view bytes, const std::string& name) {
  MeshFiles files;
  const std::string copy = "copy-" + name;
  MeshFile file = files.read(bytes, name);
  const Points& X = file.mesh().X;
  EXPECT_EQ(files.write(file, X, copy), bytes);

  const Points Y = mostly_moved(X);
  const WriteOptions exact{.precision = WriteOptions::Precision::float64};
  files.write(file, Y, copy, exact);
  const MeshFile again = read_mesh(files.path(copy));
  EXPECT_EQ(again.mesh().X, Y);
  EXPECT_EQ(again.mesh().faces.corner, file.mesh().faces.corner);
  EXPECT_EQ(again.mesh().faces.first, file.mesh().faces.first);

  files.write(again, X, copy, exact);
  EXPECT_EQ(read_mesh(files.path(copy)).mesh().X, X);
  return file;
}

Points mostly_moved(const Points& X) {
  Points Y = X;
  for (Eigen::Index v = 0; v < Y.rows(); ++v) {
    for (int c = 0; c < 3 && v % 3 != 1; ++c) {
      const double turn = std::sin(static_cast<double>(3 * v + c + 1));
      Y(v, c) += 0.03 * turn * (std::abs(Y(v, c)) + 0.1);
    }
  }
  return Y;
}

std::vector<int> different_lines(std::string_view a, std::string_view b) {
  std::vector<int> lines;
  if (std::count(a.begin(), a.end(), '\n') != std::count(b.begin(), b.end(), '\n')) return {-1};
  for (int line = 1; !a.empty() || !b.empty(); ++line) {
    const auto cut = [](std::string_view& text) {
      const std::size_t stop = std::min(text.find('\n'), text.size());
      const std::string_view first = text.substr(0, stop);
      text.remove_prefix(std::min(stop + 1, text.size()));
      return first;
    };
    if (cut(a) != cut(b)) lines.push_back(line);
  }
  return lines;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
  return text;
}

std::string to_bytes(double value, int size, bool big_endian, bool real) {
  std::string bytes(static_cast<std::size_t>(size), '\0');
  if (real && size == 4) {
    const auto single = static_cast<float>(value);
    std::memcpy(bytes.data(), &single, 4);
  } else if (real) {
    std::memcpy(bytes.data(), &value, 8);
  } else {
    const auto integer = static_cast<std::int64_t>(value);
    std::memcpy(bytes.data(), &integer, bytes.size());
  }
  if (big_endian) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

}  // namespace ibmfair::test
