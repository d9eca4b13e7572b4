#include "ibmfair/io/import_reply.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/process_memory.h"
#include "ibmfair/io/import_process.h"
#include "ibmfair/io/source_bytes.h"

namespace ibmfair {
namespace {

/// What helps where assimp cannot read a file that other programs may read.
constexpr std::string_view remedy =
    "; if another program opens the file, save it there as OBJ, PLY, OFF or STL";

template <std::size_t columns>
bool all_finite(const std::vector<std::array<double, columns>>& rows) {
  return std::all_of(rows.begin(), rows.end(), [](const std::array<double, columns>& row) {
    return std::all_of(row.begin(), row.end(), [](double x) { return std::isfinite(x); });
  });
}

/// Whether this process, and so every process that it starts, has a lower limit on address space.
bool is_limited_below(const ImportLimits& limits) {
  return address_space_limit() < static_cast<double>(limits.memory);
}

std::string memory_text(std::int64_t bytes) {
  return fmt::format("{:.3g} MB", static_cast<double>(bytes) / 1e6);
}

class ImportReceiver {
 public:
  ImportReceiver(ImportProcess& process, const SourceBytes& source, const ImportLimits& limits)
      : process_(process), source_(source), limits_(limits) {}

  ParsedMesh result() {
    receive(&header_, sizeof header_);
    const std::string message = receive_text(header_.message_size);
    outside_ = receive_text(header_.outside_size);
    if (header_.status == ImportStatus::out_of_memory) fail_for_memory();
    if (header_.status != ImportStatus::done) fail_as_refused(message);
    check_counts();
    ParsedMesh parsed;
    parsed.mesh = receive_mesh();
    parsed.attributes = receive_attributes(parsed.mesh.faces);
    parsed.has_normals = header_.normals != 0;
    parsed.has_texture_coordinates = header_.texture != 0;
    add_notes(parsed);
    return parsed;
  }

 private:
  void receive(void* data, std::size_t size) {
    if (!process_.receive(data, size)) fail_for_end(process_.end());
  }

  template <class T>
  std::vector<T> receive_list(std::uint64_t count) {
    std::vector<T> list(static_cast<std::size_t>(count));
    receive(list.data(), list.size() * sizeof(T));
    return list;
  }

  std::string receive_text(std::uint64_t size) {
    require(size <= longest_import_text);
    std::string text(static_cast<std::size_t>(size), '\0');
    receive(text.data(), text.size());
    return text;
  }

  /// Checks the counts before memory is allocated for them: the process cannot have held more data
  /// than its memory limit.
  void check_counts() const {
    constexpr auto most = static_cast<std::uint64_t>(std::numeric_limits<Index>::max());
    require(header_.vertices <= most && header_.corners <= most);
    require(header_.faces <= header_.corners / 3 && header_.left_out_faces <= most);
    const std::uint64_t vertex_reals = 3 + 2 * header_.texture + 4 * header_.colours;
    require(header_.normals <= 1 && header_.texture <= 1 && header_.colours <= 1);
    const std::uint64_t bytes = header_.vertices * vertex_reals * sizeof(double) +
                                header_.faces * sizeof(std::int64_t) +
                                header_.corners * sizeof(Index);
    require(bytes <= static_cast<std::uint64_t>(limits_.memory));
  }

  Mesh receive_mesh() {
    Mesh mesh;
    mesh.X.resize(static_cast<Eigen::Index>(header_.vertices), 3);
    receive(mesh.X.data(), static_cast<std::size_t>(mesh.X.size()) * sizeof(double));
    require(mesh.X.allFinite());
    Polygons& faces = mesh.faces;
    faces.first = receive_list<std::int64_t>(header_.faces + 1);
    require(faces.first.front() == 0 &&
            faces.first.back() == static_cast<std::int64_t>(header_.corners));
    const auto too_short = [](std::int64_t a, std::int64_t b) { return b < a || b - a < 3; };
    require(std::adjacent_find(faces.first.begin(), faces.first.end(), too_short) ==
            faces.first.end());
    faces.corner = receive_list<Index>(header_.corners);
    require(std::all_of(faces.corner.begin(), faces.corner.end(), [&](Index v) {
      return v >= 0 && v < static_cast<Index>(header_.vertices);
    }));
    return mesh;
  }

  MeshAttributes receive_attributes(const Polygons& faces) {
    MeshAttributes attributes;
    attributes.normals = header_.normals != 0;
    attributes.opacity = header_.colours != 0;
    if (header_.texture != 0) {
      attributes.texture_coordinates = receive_list<std::array<double, 2>>(header_.vertices);
      require(all_finite(attributes.texture_coordinates));
      // There is one texture coordinate for each vertex, so corners refer to it by the vertex
      // number.
      attributes.corner_texture = faces.corner;
    }
    if (header_.colours != 0) {
      attributes.colours = receive_list<std::array<double, 4>>(header_.vertices);
      require(all_finite(attributes.colours));
    }
    return attributes;
  }

  void add_notes(ParsedMesh& parsed) const {
    parsed.notes.emplace_back(
        "read through assimp: coordinates are float32, and vertices and faces are numbered as its "
        "importer found them");
    if (header_.left_out_faces > 0) {
      parsed.notes.push_back(
          fmt::format("left out {} points and lines, which are not part of the surface",
                      header_.left_out_faces));
    }
    if (!outside_.empty()) parsed.notes.push_back(about_outside());
  }

  /// A sentence about the file outside the folder; empty if there is no such file.
  std::string about_outside() const {
    return outside_.empty()
               ? std::string()
               : fmt::format("it refers to '{}' outside its folder, which is not read", outside_);
  }

  [[noreturn]] void fail_as_refused(const std::string& message) const {
    fail_in_file(source_, outside_.empty() ? message : message + "; " + about_outside());
  }

  void require(bool plausible) const {
    if (!plausible) fail_in_file(source_, fmt::format("assimp's reply makes no sense{}", remedy));
  }

  [[noreturn]] void fail_for_memory() const {
    if (is_limited_below(limits_)) {
      throw OutOfMemory(
          fmt::format("{}: assimp needs more memory to read it than there is", source_.name()));
    }
    fail_in_file(source_, fmt::format("assimp needs more than {} of memory to read it{}",
                                      memory_text(limits_.memory), remedy));
  }

  [[noreturn]] void fail_for_end(const ProcessEnd& end) const {
    constexpr int cannot_load = 127;  // the exit code if the dynamic linker fails
    if (end.timed_out || end.signal_number == SIGXCPU) {
      fail_in_file(source_, fmt::format("assimp needs more than {} s to read it{}",
                                        limits_.time.count(), remedy));
    }
    if (end.exit_code == cannot_load && is_limited_below(limits_)) fail_for_memory();
    if (end.signal_number != 0) {
      fail_in_file(source_,
                   fmt::format("assimp, which reads this format, crashed (signal {}, {}){}",
                               end.signal_number, strsignal(end.signal_number), remedy));
    }
    fail_in_file(
        source_,
        fmt::format("assimp, which reads this format, ended without a reply (exit code {}){}",
                    end.exit_code, remedy));
  }

  ImportProcess& process_;
  const SourceBytes& source_;
  const ImportLimits& limits_;
  ImportHeader header_;
  std::string outside_;
};

}  // namespace

ParsedMesh receive_import(ImportProcess& process, const SourceBytes& source,
                          const ImportLimits& limits) {
  return ImportReceiver(process, source, limits).result();
}

}  // namespace ibmfair
