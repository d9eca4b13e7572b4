// The process in which assimp reads a file may hang, crash or take all memory: the only consequence
// is that the file cannot be read.
#include <atomic>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/io/assimp_import.h"
#include "ibmfair/io/source_bytes.h"
#include "support/foreign_meshes.h"
#include "support/mesh_io.h"
#include "support/run_program.h"

namespace ibmfair::test {
namespace {

/// The end of every message about a file that assimp does not survive.
const std::string remedy =
    "; if another program opens the file, save it there as OBJ, PLY, OFF or STL";

constexpr ImportLimits generous{std::chrono::seconds(60), std::int64_t{4} << 30};

/// A file with one facet many times, a text that takes assimp a while to read.
std::string stl_of(int facets) {
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1.0625 0 0\nvertex 1 1.03125 0\n"
      "endloop\nendfacet\n";
  std::string text = "solid many\n";
  for (int i = 0; i < facets; ++i) {
    text += facet;
  }
  return text + "endsolid many\n";
}

/// A scene that doubles itself at every node: a few kilobytes of text describe an endless number of
/// meshes.
std::string exploding_gltf(int levels) {
  std::string nodes = R"({"mesh":0})";
  for (int i = 0; i < levels; ++i) {
    nodes += fmt::format(R"(,{{"children":[{0},{0}]}})", i);
  }
  std::string text = triangle_gltf(
      "data:application/octet-stream;base64,"
      "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA");
  text.replace(text.find(R"({"mesh":0})"), std::string(R"({"mesh":0})").size(), nodes);
  text.replace(text.find(R"("nodes":[0])"), std::string(R"("nodes":[0])").size(),
               R"("nodes":[)" + std::to_string(levels) + "]");
  return text;
}

std::string failure(const std::string& bytes, const std::string& extension,
                    const ImportLimits& limits) {
  const auto source = SourceBytes::from_memory("hostile." + extension, bytes);
  try {
    read_through_assimp(*source, extension, limits);
  } catch (const BadFile& error) {
    return error.what();
  }
  return "";
}

/// Children of this process that run the importer.
std::vector<pid_t> import_processes() {
  std::vector<pid_t> found;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", error)) {
    std::ifstream file(entry.path() / "stat");
    pid_t id = 0, parent = 0;
    std::string name, state;
    if (file >> id >> name >> state >> parent && parent == getpid() && name == "(ibmfair-assimp)") {
      found.push_back(id);
    }
  }
  return found;
}

/// Sends a signal to every import process as soon as the process exists.
class Saboteur {
 public:
  explicit Saboteur(int signal_number)
      : thread_([this, signal_number] {
          while (!done_) {
            for (const pid_t id : import_processes()) {
              kill(id, signal_number);
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
          }
        }) {}
  ~Saboteur() {
    done_ = true;
    thread_.join();
  }
  Saboteur(const Saboteur&) = delete;
  Saboteur& operator=(const Saboteur&) = delete;

 private:
  std::atomic<bool> done_ = false;
  std::thread thread_;
};

TEST(ImportLimits, TimeIsBounded) {
  const std::string endless = "version 1\nnodes\n0 \"r\" -";
  const std::string message = failure(endless, "smd", {std::chrono::seconds(1), generous.memory});
  if (contains(message, "cannot read it")) GTEST_SKIP() << "this assimp finds the end of the file";
  EXPECT_EQ(message, "hostile.smd: assimp needs more than 1 s to read it" + remedy);
}

/// Versions of a file: cut at several places, and with changed bytes at several other places.
std::vector<std::string> spoilt(const std::string& bytes) {
  constexpr std::size_t places = 12;
  constexpr std::string_view others(
      "\0\xff"
      "9-\"{<",
      7);
  std::vector<std::string> result;
  for (std::size_t i = 0; i < places; ++i) {
    const std::size_t at = i * bytes.size() / places;
    result.push_back(bytes.substr(0, at));
    std::string changed = bytes;
    changed[at] = others[i % others.size()];
    result.push_back(changed);
  }
  return result;
}

TEST(ImportLimits, SpoiltFilesAreReadOrRefused) {
  for (const auto& [extension, bytes] : foreign_triangles()) {
    SCOPED_TRACE(extension);
    EXPECT_EQ(failure(bytes, extension, generous), "");
    for (const std::string& text : spoilt(bytes)) {
      const std::string message =
          failure(text, extension, {std::chrono::seconds(1), generous.memory});
      EXPECT_TRUE(message.empty() || contains(message, "hostile." + extension + ": ")) << message;
    }
  }
}

TEST(ImportLimits, MemoryIsBounded) {
#ifdef IBMFAIR_SANITIZED
  GTEST_SKIP() << "AddressSanitizer needs all of the address space";
#endif
  const ImportLimits limits{generous.time, std::int64_t{1} << 28};
  EXPECT_EQ(failure(exploding_gltf(3), "gltf", limits), "");
  EXPECT_EQ(failure(exploding_gltf(40), "gltf", limits),
            "hostile.gltf: assimp needs more than 268 MB of memory to read it" + remedy);
}

TEST(ImportLimits, ACrashIsReported) {
  const std::string text = stl_of(200'000);
  std::vector<int> signals{SIGABRT, SIGKILL};
#ifndef IBMFAIR_SANITIZED  // AddressSanitizer turns this signal into an exit code
  signals.push_back(SIGSEGV);
#endif
  for (const int signal_number : signals) {
    const Saboteur saboteur(signal_number);
    const std::string message = failure(text, "stl", generous);
    EXPECT_TRUE(contains(message, "hostile.stl: assimp, which reads this format, crashed (signal " +
                                      std::to_string(signal_number)))
        << message;
  }
  EXPECT_EQ(failure(text, "stl", generous), "");
  EXPECT_TRUE(import_processes().empty());
}

TEST(ImportLimits, AProcessThatDoesNothingIsEnded) {
  const Saboteur saboteur(SIGSTOP);
  const std::string message =
      failure(stl_of(100'000), "stl", {std::chrono::seconds(1), generous.memory});
  EXPECT_EQ(message, "hostile.stl: assimp needs more than 1 s to read it" + remedy);
  EXPECT_TRUE(import_processes().empty());
}

}  // namespace
}  // namespace ibmfair::test
