// The files of the PETSc engine: no data is lost, whatever goes wrong.
#include "support/files.h"

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "ibmfair/io/mesh_file.h"
#include "ibmfair/shapes/shapes.h"
#include "petsc/ranks.h"
#include "support/mesh_io.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

Mesh noisy_sphere(int subdivide = 3) {
  Mesh mesh = make_shape("icosphere", {.subdivide = subdivide});
  mesh.X = shaken(State(mesh), 0.15);
  return mesh;
}

/// The number of bytes of a vertex of rich_ply behind its coordinates and normals. No run may
/// change these bytes.
constexpr std::size_t pace_bytes = 3;

/// A binary PLY file with normals, a property `pace` (0, 1, 2 in turn), properties of faces, and
/// other elements before and after the vertices and faces.
std::string rich_ply(const Mesh& mesh, bool big_endian) {
  std::string bytes = fmt::format(
      "ply\nformat binary_{}_endian 1.0\ncomment of a scan\nelement camera 1\nproperty double f\n"
      "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\nproperty uchar red\n"
      "property short pace\nelement face {}\nproperty uchar flags\n"
      "property list uchar int vertex_indices\nelement tail 2\nproperty list uchar short t\n"
      "end_header\n",
      big_endian ? "big" : "little", mesh.X.rows(), mesh.faces.size());
  bytes += to_bytes(35.5, 8, big_endian, true);
  for (Index v = 0; v < mesh.X.rows(); ++v) {
    for (int round = 0; round < 2; ++round) {
      for (int c = 0; c < 3; ++c) {
        bytes += to_bytes(mesh.X(v, c), 4, big_endian, true);
      }
    }
    bytes += to_bytes(v % 200, 1, big_endian, false) + to_bytes(v % 3, 2, big_endian, false);
  }
  for (Index f = 0; f < mesh.faces.size(); ++f) {
    bytes += to_bytes(f % 7, 1, big_endian, false) + to_bytes(3, 1, big_endian, false);
    for (const Index v : mesh.faces[f]) {
      bytes += to_bytes(v, 4, big_endian, false);
    }
  }
  return bytes + to_bytes(1, 1, big_endian, false) + to_bytes(77, 2, big_endian, false) +
         to_bytes(0, 1, big_endian, false);
}

/// A PLY file of a tetrahedron with a property `value`, which is 1 at all vertices but the third.
std::string tetrahedron_with_values(double third) {
  std::string bytes =
      "ply\nformat binary_big_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nproperty float value\nelement face 4\n"
      "property list uchar int vertex_indices\nend_header\n";
  const Mesh mesh = closed_meshes().front().mesh;
  for (Index v = 0; v < 4; ++v) {
    for (const double value : {mesh.X(v, 0), mesh.X(v, 1), mesh.X(v, 2), v == 2 ? third : 1}) {
      bytes += to_bytes(value, 4, true, true);
    }
  }
  for (Index f = 0; f < 4; ++f) {
    bytes += to_bytes(3, 1, true, false);
    for (const Index v : mesh.faces[f]) {
      bytes += to_bytes(v, 4, true, false);
    }
  }
  return bytes;
}

class RankFiles : public RanksTest {
 protected:
  std::string rich_file(bool big_endian) const {
    const std::string path = files_ / "rich.ply";
    write_bytes(path, rich_ply(noisy_sphere(), big_endian));
    return path;
  }

  bool left_something() const {
    return std::filesystem::exists(files_ / "ranks.ply") || files_.entries() > 1;
  }
};

TEST_F(RankFiles, KeepEveryByteWhereNothingMoves) {
  for (const bool big_endian : {false, true}) {
    const std::string input = rich_file(big_endian);
    for (const int ranks : {1, 2, 3}) {
      EXPECT_EQ(on_ranks(ranks, input, {"--steps", "0"}).bytes, read_bytes(input)) << ranks;
    }
  }
}

TEST_F(RankFiles, AreWrittenAsOneProcessWritesThem) {
  for (const bool big_endian : {false, true}) {
    const std::string input = rich_file(big_endian);
    const Fair one = on_one(input, {"--steps", "2"});
    const std::size_t body = one.bytes.find("end_header\n") + 11 + 8;
    constexpr std::size_t row = 3 * 8 + 3 * 4 + pace_bytes;  // coordinates are double now
    const std::size_t end = body + row * one.X().rows();
    for (const int ranks : {1, 2, 3}) {
      const Fair several = on_ranks(ranks, input, {"--steps", "2"});
      ASSERT_EQ(several.bytes.size(), one.bytes.size()) << several.run.err;
      EXPECT_LT(relative_difference(one.X(), several.X()), 1e-8);
      for (std::size_t i = 0; i < one.bytes.size(); ++i) {
        const bool in_vertices = i >= body && i < end;
        if (!in_vertices || (i - body) % row >= row - pace_bytes) {
          ASSERT_EQ(several.bytes[i], one.bytes[i]) << "byte " << i << ", ranks " << ranks;
        }
      }
    }
  }
}

TEST_F(RankFiles, RenewNormalsAsOneProcessDoes) {
  const std::string input = rich_file(false);
  const auto normals = [](const Fair& fair) {
    TemporaryDirectory directory;
    write_bytes(directory / "a.ply", fair.bytes);
    const MeshFile file = read_mesh(directory / "a.ply");
    Points N(file.mesh().X.rows(), 3);
    for (const auto& [c, name] : {std::pair{0, "nx"}, {1, "ny"}, {2, "nz"}}) {
      const std::vector<double> column = *file.vertex_values(name);
      N.col(c) = Eigen::Map<const Eigen::VectorXd>(column.data(), std::ssize(column));
    }
    return N;
  };
  const Points one = normals(on_one(input, {"--steps", "2"}));
  EXPECT_LT((one - normals(on_ranks(3, input, {"--steps", "2"}))).cwiseAbs().maxCoeff(), 1e-6);
}

TEST_F(RankFiles, SayWhichVerticesMove) {
  const std::string input = rich_file(false);
  for (const Words& options : {Words{"--mask", "pace"}, Words{"--weights", "pace"}}) {
    const Fair one = on_one(input, Words{"--steps", "2"} + options);
    const Fair several = on_ranks(3, input, Words{"--steps", "2"} + options);
    EXPECT_LT(relative_difference(one.X(), several.X()), 1e-8) << options[0];
    EXPECT_EQ(several.report["moved_vertices"], one.report["moved_vertices"]) << options[0];
  }
}

TEST_F(RankFiles, OfOtherFormatsAreReadByTheFirstRank) {
  const Mesh mesh = noisy_sphere();
  for (const char* name : {"in.obj", "in.off"}) {
    write_mesh(mesh, files_ / name, {.overwrite = true});
    const Fair one = on_one(files_ / name, {"--steps", "2"});
    const Fair several = on_ranks(2, files_ / name, {"--steps", "2"});
    EXPECT_LT(relative_difference(one.X(), several.X()), 1e-8) << name;
    EXPECT_TRUE(contains(several.run.err, "the first rank reads and writes it whole")) << name;
  }
}

TEST_F(RankFiles, ThatExistAreReplacedOnlyWhereAllowed) {
  const std::string input = rich_file(false);
  write_bytes(files_ / "there.ply", "mine");
  const RunResult run =
      run_on_ranks(2, {"smooth", input, files_ / "there.ply", "--engine", "petsc", "--steps", "1"});
  EXPECT_EQ(run.exit_code, 6) << run.err;
  EXPECT_EQ(read_bytes(files_ / "there.ply"), "mine");
}

TEST_F(RankFiles, LeaveNothingWhereTheDiskIsFull) {
  const Words small_disk{"/usr/bin/unshare",
                         "--map-root-user",
                         "--mount",
                         "/bin/sh",
                         "-c",
                         "mount -t tmpfs -o size=64k none \"$0\" && \"$@\"; code=$?; "
                         "ls -A \"$0\" >&2; exit $code"};
  const std::string disk = files_ / "disk";
  std::filesystem::create_directory(disk);
  if (run_program({"--version"}, {.launcher = small_disk + Words{disk}}).exit_code != 0) {
    GTEST_SKIP() << "no file system can be mounted here";
  }
  const std::string input = files_ / "in.ply";
  write_bytes(input, rich_ply(noisy_sphere(4), false));  // 150 kB
  const RunResult run =
      run_on_ranks(3, {"smooth", input, disk + "/ranks.ply", "--engine", "petsc", "--steps", "1"},
                   {.launcher = small_disk + Words{disk}});
  EXPECT_EQ(run.exit_code, 6) << run.err;
  EXPECT_TRUE(contains(run.err, "ranks.ply: cannot be written")) << run.err;
  EXPECT_FALSE(contains(run.err, "\n.ibmfair")) << run.err;
  EXPECT_FALSE(contains(run.err, "\nranks.ply")) << run.err;
}

TEST_F(RankFiles, LeaveNothingWhereARankDies) {
  const std::string input = file_of(noisy_sphere(6));
  const auto a_rank_runs = [&] {
    return std::system(
               "pkill -KILL -n -f '^[^ ]*/ibmfair smooth .*ranks.ply --engine petsc --steps "
               "9999'") == 0;
  };
  const RunResult run = run_on_ranks(
      2, {"smooth", input, files_ / "ranks.ply", "--engine", "petsc", "--steps", "9999"},
      {.signal_number = SIGCONT, .signal_when = a_rank_runs});
  EXPECT_NE(run.exit_code, 0);
  EXPECT_FALSE(left_something());
}

TEST_F(RankFiles, ThatAreBrokenGiveTheErrorOfOneProcess) {
  const std::string good = rich_ply(noisy_sphere(1), false);
  const std::string input = files_ / "bad.ply";
  for (const std::string& bytes : {good.substr(0, good.size() - 40), good.substr(0, 200),
                                   replaced(good, "list uchar int", "list uchar float"),
                                   std::string("ply\n"), std::string()}) {
    write_bytes(input, bytes);
    const RunResult one = run_program({"smooth", input, files_ / "ranks.ply"});
    const RunResult several =
        run_on_ranks(2, {"smooth", input, files_ / "ranks.ply", "--engine", "petsc"});
    EXPECT_EQ(several.exit_code, one.exit_code);
    const std::string message = one.err.substr(0, one.err.find('\n'));
    EXPECT_TRUE(contains(several.err, message)) << several.err;
    EXPECT_EQ(several.err.find(message), several.err.rfind(message)) << "said once";
    EXPECT_FALSE(left_something());
  }
}

TEST_F(RankFiles, AndValuesThatNoVertexCanHaveAreNamed) {
  const std::vector<std::pair<std::string, double>> wrong{
      {"--weights", -1}, {"--weights", std::nan("")}, {"--h0", HUGE_VAL}};
  for (const auto& [option, value] : wrong) {
    write_bytes(files_ / "values.ply", tetrahedron_with_values(value));
    const Words smooth{
        "smooth", files_ / "values.ply", files_ / "ranks.ply", "--laplacian", "lagrange", option,
        "value"};
    const RunResult one = run_program(smooth);
    const RunResult several = run_on_ranks(2, smooth + Words{"--engine", "petsc"});
    EXPECT_EQ(one.exit_code, 3) << one.err;
    EXPECT_EQ(several.exit_code, 3) << several.err;
    EXPECT_TRUE(contains(several.err, one.err)) << several.err << one.err;
    EXPECT_FALSE(left_something());
  }
}

TEST_F(RankFiles, HaveTheTypeOfCoordinatesThatOneProcessWrites) {
  const auto type_of = [](const std::string& path) {
    const std::string bytes = read_bytes(path);
    const std::size_t at = bytes.find("property ") + 9;
    return bytes.substr(at, bytes.find(' ', at) - at);
  };
  for (const std::string move : {"0,0,0", "1e6,0,0"}) {
    ASSERT_EQ(run_program({"make", "icosphere", files_ / "in.ply", "--subdivide", "3", "--noise",
                           "0.1", "--precision", "float", "--move", move, "--overwrite"})
                  .exit_code,
              0);
    for (const std::string precision : {"keep", "float", "double"}) {
      SCOPED_TRACE(move + " " + precision);
      const Words smooth{"smooth", files_ / "in.ply", files_ / "out.ply", "--steps",
                         "2",      "--precision",     precision,          "--overwrite"};
      EXPECT_EQ(run_program(smooth).exit_code, 0);
      const std::string one = type_of(files_ / "out.ply");
      const RunResult several = run_on_ranks(2, smooth + Words{"--engine", "petsc"});
      EXPECT_EQ(several.exit_code, 0) << several.err;
      EXPECT_EQ(type_of(files_ / "out.ply"), one);
      EXPECT_EQ(one, precision == "keep" ? (move[0] == '0' ? "float" : "double") : precision);
      EXPECT_EQ(contains(several.err, "--precision float rounds them"),
                precision == "keep" && one == "double");
    }
  }
}

TEST_F(RankFiles, AndOptionsThatDoNotFitAreNamed) {
  const std::string input = rich_file(false);
  const auto refused = [&](const Words& options) {
    const RunResult run = run_on_ranks(
        2, Words{"smooth", input, files_ / "ranks.ply", "--engine", "petsc"} + options);
    EXPECT_EQ(run.exit_code, 2) << run.err;
    return run.err;
  };
  EXPECT_TRUE(contains(refused({"--mask", "red-ish"}), "no vertex property is called 'red-ish'"));
  EXPECT_TRUE(contains(refused({"--picture", files_ / "a.png"}), "--picture"));
  EXPECT_TRUE(contains(refused({"--keep-volume"}), "--keep-volume"));
  EXPECT_TRUE(
      contains(refused({"--laplacian", "intrinsic-delaunay"}), "the whole mesh in one process"));
  EXPECT_TRUE(contains(refused({"--stepps", "3"}), "--steps"));
  EXPECT_FALSE(left_something());
}

}  // namespace
}  // namespace ibmfair::test
