// A file that is read through assimp can neither reach files outside its folder, nor make the
// program believe a forged reply of the process that reads the file.
#include <cstring>
#include <filesystem>
#include <limits>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/io/assimp_import.h"
#include "ibmfair/io/import_process.h"
#include "ibmfair/io/source_bytes.h"
#include "support/files.h"
#include "support/foreign_meshes.h"
#include "support/mesh_io.h"
#include "support/run_program.h"

namespace ibmfair::test {
namespace {

namespace fs = std::filesystem;

/// A folder `in` with a scene, and a folder `out` with the buffer that the scene refers to.
class ReferenceTest : public testing::Test {
 protected:
  ReferenceTest() {
    fs::create_directories(folder_ / "in/sub");
    fs::create_directories(folder_ / "out");
    write_bytes(folder_ / "out/secret.bin", triangle_buffer());
  }

  /// The message that refuses a scene with this reference; empty if the scene is read.
  std::string refusal(const std::string& uri) const {
    write_bytes(folder_ / "in/scene.gltf", triangle_gltf(uri));
    try {
      EXPECT_EQ(read_mesh(folder_ / "in/scene.gltf").mesh().X.rows(), 3);
      return "";
    } catch (const BadFile& error) {
      return error.what();
    }
  }

  void link(const std::string& target, const std::string& name) const {
    fs::create_symlink(target, folder_ / name);
  }

  TemporaryDirectory folder_;
};

TEST_F(ReferenceTest, FilesInTheFolderAreRead) {
  if (!imports_can_refer_to_files()) GTEST_SKIP() << "no openat2";
  write_bytes(folder_ / "in/a.bin", triangle_buffer());
  write_bytes(folder_ / "in/sub/b.bin", triangle_buffer());
  link("sub/b.bin", "in/link.bin");
  for (const std::string uri : {"a.bin", "sub/b.bin", "./sub/../a.bin", "link.bin"}) {
    EXPECT_EQ(refusal(uri), "") << uri;
  }
}

TEST_F(ReferenceTest, FilesOutsideAreNot) {
  if (!imports_can_refer_to_files()) GTEST_SKIP() << "no openat2";
  link("../out/secret.bin", "in/link.bin");
  link(folder_ / "out/secret.bin", "in/absolute.bin");
  link("../out", "in/folder");
  for (const std::string uri :
       {"../out/secret.bin", "sub/../../out/secret.bin", "../in/../out/secret.bin", "link.bin",
        "absolute.bin", "folder/secret.bin"}) {
    const std::string message = refusal(uri);
    EXPECT_TRUE(contains(message, "scene.gltf: ")) << uri << ": " << message;
    EXPECT_TRUE(contains(message, "outside its folder")) << uri << ": " << message;
  }
}

TEST_F(ReferenceTest, AbsoluteNamesAndAddressesAreNotFollowed) {
  if (!imports_can_refer_to_files()) GTEST_SKIP() << "no openat2";
  for (const std::string scheme : {"", "http://localhost:9/", "file://", "https://", "ftp://"}) {
    EXPECT_NE(refusal(scheme + (folder_ / "out/secret.bin")), "") << scheme;
  }
}

TEST_F(ReferenceTest, OnlyRegularFilesAreOpened) {
  if (!imports_can_refer_to_files()) GTEST_SKIP() << "no openat2";
  ASSERT_EQ(mkfifo((folder_ / "in/pipe.bin").c_str(), 0600), 0);  // reading it would wait for ever
  EXPECT_NE(refusal("pipe.bin"), "");
  EXPECT_NE(refusal("sub"), "");
}

TEST_F(ReferenceTest, BytesWithoutAFolderReferToNothing) {
  if (!imports_can_refer_to_files()) GTEST_SKIP() << "no openat2";
  write_bytes(folder_ / "in/a.bin", triangle_buffer());
  const RunOptions in_folder{.input = triangle_gltf("a.bin"), .directory = folder_ / "in"};
  const RunResult result = run_program({"info", "-", "--input-format", "gltf"}, in_folder);
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_TRUE(contains(result.err, "standard input: ")) << result.err;
}

TEST_F(ReferenceTest, AnOddFormatNameIsNoWayRoundTheImporterThatItNames) {
  write_bytes(folder_ / "in/a.stl", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_THROW(read_mesh(folder_ / "in/a.stl"), BadFile);
}

/// A forged reply: a foreign process sends these bytes and ends.
class ForgedReply {
 public:
  explicit ForgedReply(const std::string& bytes) { write_bytes(folder_ / "reply", bytes); }

  /// The mesh that the program makes of the reply.
  ParsedMesh received(ImportLimits limits = {std::chrono::seconds(10), 1 << 20}) const {
    const auto source = SourceBytes::from_memory("a.stl", "hostile");
    ImportProcess process("/bin/sh", {"-c", "cat \"$0\" >&0", folder_ / "reply"}, limits.time);
    process.send(source->view());
    return receive_import(process, *source, limits);
  }

 private:
  TemporaryDirectory folder_;
};

template <class T>
std::string raw(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// A reply with one triangle, whose parts the tests spoil.
struct Reply {
  ImportHeader header{.vertices = 3, .faces = 1, .corners = 3};
  std::vector<double> positions{0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::vector<std::int64_t> first{0, 3};
  std::vector<std::int32_t> corner{0, 1, 2};

  std::string bytes() const {
    std::string result(sizeof header, '\0');
    std::memcpy(result.data(), &header, sizeof header);
    return result + raw(positions) + raw(first) + raw(corner);
  }
};

TEST(ImportReply, IsReceivedAsItWasSent) {
  const ParsedMesh parsed = ForgedReply(Reply().bytes()).received();
  EXPECT_EQ(parsed.mesh.X.rows(), 3);
  EXPECT_EQ(parsed.mesh.X(1, 0), 1.0);
  EXPECT_EQ(parsed.mesh.faces.corner, (std::vector<Index>{0, 1, 2}));
}

TEST(ImportReply, ThatMakesNoSenseIsRefused) {
  constexpr std::uint64_t huge = std::numeric_limits<std::uint64_t>::max();
  std::vector<Reply> replies;
  const auto spoilt = [&]() -> Reply& { return replies.emplace_back(); };
  for (const std::uint64_t count : {std::uint64_t{1} << 31U, std::uint64_t{1} << 61U, huge}) {
    spoilt().header.vertices = count;
    spoilt().header.corners = count;
    spoilt().header.faces = count;
  }
  spoilt().header.vertices = 1U << 17U;  // needs more than the memory limit
  spoilt().header.message_size = huge;
  spoilt().header.outside_size = 1U << 20U;
  spoilt().header.texture = 2;
  spoilt().header.colours = huge;
  spoilt().positions[4] = std::numeric_limits<double>::quiet_NaN();
  spoilt().first = {1, 3};
  spoilt().first = {0, 2};
  spoilt().corner[1] = 3;
  spoilt().corner[1] = -1;
  Reply& folded = spoilt();
  folded.header.faces = 2;
  folded.header.corners = 6;
  folded.first = {0, std::numeric_limits<std::int64_t>::min(), 6};
  folded.corner = {0, 1, 2, 0, 1, 2};
  spoilt().corner.pop_back();  // the reply ends too early
  for (const Reply& reply : replies) {
    SCOPED_TRACE(&reply - replies.data());
    EXPECT_THROW(ForgedReply(reply.bytes()).received(), BadFile);
  }
}

TEST(ImportReply, CutAnywhereIsRefused) {
  const std::string whole = Reply().bytes();
  for (std::size_t size = 0; size < whole.size(); size += 7) {
    EXPECT_THROW(ForgedReply(whole.substr(0, size)).received(), BadFile) << size;
  }
}

}  // namespace
}  // namespace ibmfair::test
