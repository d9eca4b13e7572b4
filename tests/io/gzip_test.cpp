// Meshes in gzip files are read and written like other meshes.
#include "ibmfair/base/gzip.h"

#include <string>

#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/io/formats.h"
#include "ibmfair/io/source_bytes.h"
#include "support/files.h"
#include "support/mesh_io.h"
#include "support/meshes.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {
namespace {

std::string plain(const std::string& zipped) {
  std::string text;
  EXPECT_EQ(gunzip(zipped, [&](std::string_view piece) { text += piece; }), "");
  return text;
}

std::string long_text() {
  std::string text;
  for (int i = 0; i < 100'000; ++i) {
    text += std::to_string(i * 7919 % 10'007) + ' ';
  }
  return text;
}

TEST(Gzip, ComesBack) {
  for (const std::string& text : {std::string(), std::string("f 1 2 3\n"), long_text()}) {
    const std::string zipped = gzip(text);
    EXPECT_TRUE(is_gzip(zipped));
    EXPECT_EQ(plain(zipped), text);
    EXPECT_EQ(plain(zipped + zipped), text + text);  // two members
    EXPECT_EQ(plain(zipped + std::string(512, '\0')), text);
  }
}

TEST(Gzip, TellsDamage) {
  const std::string zipped = gzip(long_text());
  const auto problem = [](const std::string& bytes) {
    return gunzip(bytes, [](std::string_view) {});
  };
  for (const std::size_t size : {std::size_t{2}, std::size_t{17}, zipped.size() - 1}) {
    EXPECT_NE(problem(zipped.substr(0, size)), "") << size;
  }
  for (const std::size_t place : {zipped.size() / 2, zipped.size() - 6}) {
    std::string damaged = zipped;
    damaged[place] = static_cast<char>(damaged[place] ^ 1);
    EXPECT_NE(problem(damaged), "") << place;
  }
  EXPECT_NE(problem(zipped + "f 1 2 3"), "");
}

TEST(Gzip, MeshesOfEveryFormatAreReadAndWritten) {
  const TemporaryDirectory directory;
  for (const NamedMesh& named : good_meshes()) {
    for (const Format& format : formats()) {
      if (format.generate == nullptr) continue;
      SCOPED_TRACE(named.name + " " + std::string(format.name));
      const std::string name = directory / ("a." + std::string(format.name));
      write_mesh(named.mesh, name, {.overwrite = true});
      write_mesh(named.mesh, name + ".gz", {.overwrite = true});
      EXPECT_EQ(plain(read_bytes(name + ".gz")), read_bytes(name));
      const MeshFile file = read_mesh(name), zipped = read_mesh(name + ".gz");
      EXPECT_EQ(&zipped.format(), &format);
      EXPECT_EQ(zipped.bytes().view(), file.bytes().view());
      const Points Y = mostly_moved(file.mesh().X);
      write_mesh(file, Y, name, {.overwrite = true});
      write_mesh(zipped, Y, name + ".GZ", {.overwrite = true});
      EXPECT_EQ(plain(read_bytes(name + ".GZ")), read_bytes(name));
    }
  }
}

TEST(Gzip, DamagedMeshesAreRefused) {
  const TemporaryDirectory directory;
  const std::string path = directory / "a.off.gz";
  write_mesh(flat_sheet(9, 9), path);
  const std::string bytes = read_bytes(path);
  write_bytes(path, bytes.substr(0, bytes.size() / 2));
  EXPECT_THROW(read_mesh(path), BadFile);
}

}  // namespace
}  // namespace ibmfair::test
