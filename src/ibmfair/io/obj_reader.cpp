// Reads the positions and faces of an OBJ text.
#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/io/make_room.h"
#include "ibmfair/io/obj.h"
#include "ibmfair/io/obj_scanner.h"

namespace ibmfair::obj {
namespace {

constexpr std::int64_t largest_index = std::numeric_limits<Index>::max();
constexpr std::int64_t unlimited = std::numeric_limits<std::int64_t>::max();

/// Whether the format defines the keyword, though this reader may not use it. Sources: the
/// Wavefront specification (appendix B1 of the Advanced Visualizer manual), with its superseded
/// statements.
bool is_keyword(std::string_view word) {
  static constexpr std::array<std::string_view, 44> keywords{
      "bevel",     "bmat",   "bsp",    "bzp",    "c_interp",   "call",     "cdc",    "cdp",  "con",
      "csh",       "cstype", "ctech",  "curv",   "curv2",      "d_interp", "deg",    "end",  "f",
      "g",         "hole",   "l",      "lod",    "maplib",     "mg",       "mtllib", "o",    "p",
      "parm",      "res",    "s",      "scrv",   "shadow_obj", "sp",       "stech",  "step", "surf",
      "trace_obj", "trim",   "usemap", "usemtl", "v",          "vn",       "vp",     "vt"};
  return std::ranges::find(keywords, word) != keywords.end();
}

/// Reads the text once. Faces may precede their vertices, so the number of vertices is known only
/// at the end: an index that is too large is detected by the largest index, and a second pass finds
/// its place in the text.
class Reader {
 public:
  Reader(const SourceBytes& source, std::int64_t vertex_limit)
      : source_(source), scan_(source), vertex_limit_(vertex_limit) {
    reserve();
  }

  /// Also checks the numbers of `vt` and `vn`, which are needed only for writing, so that an error
  /// is reported before the computation and not after it.
  void run() {
    while (scan_.next_statement()) {
      const std::string_view keyword = scan_.keyword();
      if (keyword == "v") {
        read_vertex();
      } else if (keyword == "f") {
        read_face();
      } else if (keyword == "vt") {
        scan_.skip_number();
        if (!scan_.at_statement_end()) scan_.skip_number();
        ++texture_count_;
      } else if (keyword == "vn") {
        for (int c = 0; c < 3; ++c)
          scan_.skip_number();
        ++normal_count_;
      } else if (!is_keyword(keyword)) {
        if (unknown_count_++ == 0) first_unknown_ = scan_.statement_start();
      }
    }
  }

  std::int64_t vertex_count() const { return vertex_count_; }
  std::int64_t largest_vertex() const { return largest_vertex_; }

  ParsedMesh result() {
    ParsedMesh parsed;
    mesh_.X.conservativeResize(vertex_count_, 3);
    parsed.mesh = std::move(mesh_);
    parsed.has_texture_coordinates = texture_count_ > 0;
    parsed.has_normals = normal_count_ > 0;
    if (unknown_count_ > 0) add_unknown(parsed);
    return parsed;
  }

 private:
  void add_unknown(ParsedMesh& parsed) const {
    const TextPlace place = text_place(source_, first_unknown_);
    parsed.unknown = {unknown_count_, place.line, word_at(source_, first_unknown_)};
    parsed.warnings.push_back(fmt::format(
        "{}:{}:{}: unknown keyword '{}'; such lines are not read (there {}). If they are misspelt "
        "vertices or faces, correct the file",
        source_.name(), place.line, place.column, parsed.unknown.keyword,
        unknown_count_ == 1 ? "is 1" : fmt::format("are {}", unknown_count_)));
  }

  /// Reserves memory for the mesh that a file of this size usually holds. Unused memory costs
  /// nothing, whereas growing and copying takes a third of the time.
  void reserve() {
    constexpr std::int64_t bytes_per_statement = 24;
    const std::int64_t statements =
        static_cast<std::int64_t>(source_.size()) / bytes_per_statement + 1;
    make_room(mesh_, statements, statements, 2 * statements);
  }

  void read_vertex() {
    if (vertex_count_ == mesh_.X.rows()) mesh_.X.conservativeResize(2 * vertex_count_, 3);
    double* x = mesh_.X.row(vertex_count_).data();
    for (int c = 0; c < 3; ++c)
      x[c] = scan_.real();
    ++vertex_count_;
    if (vertex_count_ > largest_index) scan_.fail(scan_.statement_start(), "too many vertices");
    if (!scan_.at_statement_end()) read_more_of_vertex();
  }

  /// Reads the numbers after x, y and z: a single weight, which must be 1, or a colour, which may
  /// have any values.
  void read_more_of_vertex() {
    const char* start = scan_.position();
    scan_.skip_number();
    if (!scan_.at_statement_end()) {
      while (!scan_.at_statement_end())
        scan_.skip_number();
      return;
    }
    double weight = 0.0;
    const char* after = parse_real(start, source_.end(), weight);
    if (after == nullptr || weight != 1.0) {
      scan_.fail(start, "rational vertices (a weight other than 1) are not supported");
    }
  }

  void read_face() {
    const auto first = static_cast<std::int64_t>(mesh_.faces.corner.size());
    while (!scan_.at_statement_end()) {
      const char* start = scan_.position();
      const std::int64_t vertex = resolve(scan_.corner().vertex, start);
      if (vertex > largest_vertex_) largest_vertex_ = vertex;
      mesh_.faces.corner.push_back(static_cast<Index>(std::min(vertex, largest_index)));
    }
    const auto last = static_cast<std::int64_t>(mesh_.faces.corner.size());
    if (last - first < 3) {
      scan_.fail(scan_.statement_start(), "a face needs at least three corners");
    }
    if (last > largest_index) scan_.fail(scan_.statement_start(), "too many face corners");
    mesh_.faces.first.push_back(last);
  }

  std::int64_t resolve(std::int64_t raw, const char* where) const {
    if (raw == 0) scan_.fail(where, "vertices are counted from 1");
    const std::int64_t vertex = raw > 0 ? raw - 1 : vertex_count() + raw;
    if (vertex < 0) scan_.fail(where, "there are not that many vertices before this face");
    if (vertex >= vertex_limit_) {
      scan_.fail(where, fmt::format("there is no such vertex (the file has {})", vertex_limit_));
    }
    return vertex;
  }

  const SourceBytes& source_;
  ObjScanner scan_;
  std::int64_t vertex_limit_;
  std::int64_t texture_count_ = 0;
  std::int64_t normal_count_ = 0;
  std::int64_t unknown_count_ = 0;
  const char* first_unknown_ = nullptr;
  std::int64_t largest_vertex_ = -1;
  std::int64_t vertex_count_ = 0;
  Mesh mesh_;  // X may have more rows than vertex_count_
};

void require_text(const SourceBytes& source) {
  const std::string_view bytes = source.view();
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) {
    fail_in_file(source, "the text is UTF-16; save it as UTF-8");
  }
  // The whole file is searched and not only its beginning, because the position of a byte changes
  // when numbers before it are rewritten.
  const std::size_t nul = bytes.find('\0');
  if (nul != std::string_view::npos) {
    fail_in_file(source, fmt::format("not an OBJ text (byte {} is zero)", nul));
  }
}

}  // namespace

bool recognises(std::string_view bytes) {
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t stop = std::min(bytes.find_first_of("\r\n", at), bytes.size());
    const std::string_view line = bytes.substr(at, stop - at);
    for (const std::string_view start : {"v ", "mtllib ", "o ", "g ", "usemtl ", "vn ", "vt "}) {
      if (line.starts_with(start)) return true;
    }
    if (!line.empty() && line.front() != '#') return false;
    at = stop + 1;
  }
  return false;
}

ParsedMesh read(const SourceBytes& source, std::string_view /*extension*/) {
  require_text(source);
  Reader reader(source, unlimited);
  reader.run();
  if (reader.largest_vertex() >= reader.vertex_count()) {
    Reader(source, reader.vertex_count()).run();
  }
  return reader.result();
}

}  // namespace ibmfair::obj
