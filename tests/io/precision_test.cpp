// The types of coordinates in PLY files: a file of floats stays one where float32 is precise enough
// for the moves, vertices that did not move keep their bytes, and every other choice is exact.
#include "ibmfair/io/precision.h"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/mesh/geometry.h"
#include "support/mesh_io.h"
#include "support/meshes.h"

namespace ibmfair::test {
namespace {

constexpr std::array encodings{"ascii", "binary_little_endian", "binary_big_endian"};

/// One value, as text or as bytes.
std::string value(double x, int size, const std::string& encoding, bool real = true) {
  if (encoding != "ascii") return to_bytes(x, size, encoding == "binary_big_endian", real);
  return (size == 4 && real ? fmt::format("{}", static_cast<float>(x)) : fmt::format("{}", x)) +
         " ";
}

/// A PLY file with this type of coordinates and a property behind them.
std::string ply_of(const Mesh& mesh, const std::string& type, const std::string& encoding) {
  const int size = type == "float" ? 4 : 8;
  const std::string end = encoding == "ascii" ? "\n" : "";
  std::string text = fmt::format(
      "ply\nformat {0} 1.0\nelement vertex {2}\nproperty {1} x\nproperty {1} y\nproperty {1} z\n"
      "property uchar label\nelement face {3}\nproperty list uchar int vertex_indices\n"
      "end_header\n",
      encoding, type, mesh.X.rows(), mesh.faces.size());
  for (Index v = 0; v < mesh.X.rows(); ++v) {
    for (int c = 0; c < 3; ++c)
      text += value(mesh.X(v, c), size, encoding);
    text += value(v % 7, 1, encoding, false) + end;
  }
  for (Index f = 0; f < mesh.faces.size(); ++f) {
    text += value(static_cast<double>(mesh.faces[f].size()), 1, encoding, false);
    for (const Index v : mesh.faces[f])
      text += value(v, 4, encoding, false);
    text += end;
  }
  return text;
}

/// The points rounded to float32.
Points rounded(const Points& X) {
  return X.cast<float>().cast<double>();
}

/// The points with every other vertex moved by this length; not exactly representable in float32.
Points every_other_moved(const Points& X, double length) {
  Points Y = X;
  for (Eigen::Index v = 0; v < Y.rows(); v += 2)
    Y.row(v) += length / 3 * Eigen::RowVector3d(1, std::sin(static_cast<double>(v)), -1);
  return Y;
}

double mean_edge(const Mesh& mesh) {
  const RoundingSums sums(mesh, mesh.X, static_cast<Index>(mesh.X.rows()));
  return sums.lengths / static_cast<double>(sums.edges);
}

/// What is written of a mesh that was read from a PLY file and then moved.
struct Written {
  std::string before, bytes;
  WriteReport report;
  Points X;      // as read from `bytes`
  Points moved;  // as asked for
};

Written written(const Mesh& mesh, const std::string& type, const std::string& encoding,
                double move_in_edges, WriteOptions::Precision precision) {
  Written result;
  result.before = ply_of(mesh, type, encoding);
  const MeshFile file = MeshFiles::read(result.before, "a.ply");
  result.moved = every_other_moved(file.mesh().X, move_in_edges * mean_edge(file.mesh()));
  MeshFiles files;
  result.bytes = files.write(file, result.moved, "b.ply", {.precision = precision}, &result.report);
  result.X = read_mesh(files.path("b.ply")).mesh().X;
  return result;
}

bool declares(const std::string& bytes, const std::string& type) {
  return bytes.find("property " + type + " x\n") != std::string::npos;
}

using Precision = WriteOptions::Precision;

TEST(Precision, FilesOfFloatsStayFilesOfFloats) {
  for (const Placement placement : {Placement::as_is, Placement::tiny, Placement::huge}) {
    for (const NamedMesh& named : placed(all_meshes(), placement)) {
      for (const std::string encoding : encodings) {
        SCOPED_TRACE(named.name + " " + encoding);
        const Written w = written(named.mesh, "float", encoding, 0.1, Precision::keep);
        EXPECT_TRUE(declares(w.bytes, "float"));
        // The shortest text of a float is not the float itself if it is read as a double.
        EXPECT_EQ(encoding == "ascii" ? rounded(w.X) : w.X, rounded(w.moved));
        EXPECT_TRUE(w.report.notes.empty());
        if (encoding == "ascii") {
          const auto lines = different_lines(w.bytes, w.before);
          EXPECT_EQ(std::ssize(lines), w.report.moved_vertices);
        } else {
          EXPECT_EQ(w.bytes.size(), w.before.size());
        }
      }
    }
  }
}

TEST(Precision, BecomesDoubleWhereFloatIsTooCoarse) {
  for (const NamedMesh& named : good_meshes()) {
    const Mesh far = moved(named.mesh, 1, Vec3(3e6, 1e6, -2e6));
    for (const std::string encoding : encodings) {
      SCOPED_TRACE(named.name + " " + encoding);
      for (const Written& w : {written(far, "float", encoding, 0.1, Precision::keep),
                               written(named.mesh, "float", encoding, 1e-7, Precision::keep)}) {
        EXPECT_TRUE(declares(w.bytes, "double"));
        EXPECT_EQ(w.X, w.moved);
        ASSERT_EQ(w.report.notes.size(), 1U);
        EXPECT_NE(w.report.notes[0].find("--precision float"), std::string::npos);
      }
    }
  }
}

TEST(Precision, IsWhatWasAskedForWhetherAnythingMovesOrNot) {
  for (const NamedMesh& named : good_meshes()) {
    for (const std::string encoding : encodings) {
      for (const double move : {0.0, 0.1}) {
        SCOPED_TRACE(fmt::format("{} {} {}", named.name, encoding, move));
        const Written single = written(named.mesh, "double", encoding, move, Precision::float32);
        EXPECT_TRUE(declares(single.bytes, "float"));
        EXPECT_EQ(rounded(single.X), rounded(single.moved));
        const Written exact = written(named.mesh, "float", encoding, move, Precision::float64);
        EXPECT_TRUE(declares(exact.bytes, "double"));
        EXPECT_EQ(exact.X, exact.moved);
        const Written same = written(named.mesh, "double", encoding, move, Precision::keep);
        EXPECT_TRUE(declares(same.bytes, "double"));
        EXPECT_EQ(same.X, same.moved);
        for (const auto* w : {&single, &exact})
          EXPECT_EQ(w->report.notes.size(), 1U);
      }
    }
  }
}

TEST(Precision, CountsNewVertices) {
  // A new vertex far from the mesh needs digits that float32 does not have.
  const Mesh mesh = flat_sheet(4, 4);
  const MeshFile file = MeshFiles::read(ply_of(mesh, "float", "ascii"), "a.ply");
  MeshFiles files;
  for (const bool far : {false, true}) {
    Extension extension;
    extension.X = Points::Constant(1, 3, far ? 1e5 / 3 : 1.0 / 3);
    extension.F = Triangles{{0, 1, static_cast<Index>(mesh.X.rows())}};
    extension.model_face = {0};
    extension.rim = {0, 1};
    extension.extend = [](const Eigen::MatrixXd& at_rim) {
      return Eigen::MatrixXd(at_rim.topRows(1));
    };
    const std::string out = files.write(file, file.mesh().X, extension, "b.ply");
    EXPECT_EQ(declares(out, "double"), far);
  }
}

TEST(Precision, NothingBeyondTheRangeOfFloatIsWrittenAsFloat) {
  const Mesh mesh = moved(flat_sheet(3, 3), 1e39, Vec3::Zero());
  const MeshFile file = MeshFiles::read(ply_of(mesh, "double", "ascii"), "a.ply");
  MeshFiles files;
  const WriteOptions single{.precision = Precision::float32};
  EXPECT_THROW(files.write(file, file.mesh().X, "b.ply", single), BadMesh);
  EXPECT_THROW(write_mesh(mesh, files.path("b.ply"), single), BadMesh);
  EXPECT_EQ(files.entries(), 0U);
}

TEST(Precision, OtherFormatsSayThatItDoesNotApply) {
  const Mesh mesh = flat_sheet(3, 3);
  MeshFiles files;
  for (const std::string name : {"a.obj", "a.off", "a.stl", "a.ply"}) {
    const WriteReport report =
        write_mesh(mesh, files.path(name), {.precision = Precision::float64});
    const bool said =
        !report.notes.empty() && report.notes.back().find("--precision") != std::string::npos;
    EXPECT_EQ(said, name != "a.ply") << name;
  }
}

TEST(Precision, SumsOfPiecesAddUp) {
  for (const NamedMesh& named : good_meshes()) {
    const Points Y = every_other_moved(named.mesh.X, 0.1);
    const auto count = static_cast<Index>(Y.rows());
    const RoundingSums all(named.mesh, Y, count), none(named.mesh, Y, 0);
    EXPECT_EQ(none.edges, 0);
    EXPECT_EQ(none.written, 0);
    EXPECT_EQ(all.moved, (count + 1) / 2);
    EXPECT_TRUE(float32_suffices(all)) << named.name;
    EXPECT_EQ(all.edges, std::ssize(named.mesh.faces.corner));
  }
}

}  // namespace
}  // namespace ibmfair::test
