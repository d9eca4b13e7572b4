// Copies an OBJ text and changes only the coordinates of moved vertices and the normals that depend
// on them.
#include "ibmfair/io/byte_patcher.h"
#include "ibmfair/io/normals.h"
#include "ibmfair/io/obj.h"
#include "ibmfair/io/obj_scanner.h"

namespace ibmfair::obj {
namespace {

/// What to do with the `vn` statements. If several vertices share a normal that changes, it cannot
/// be right for all of them any more; then all normals of the file are dropped.
struct NormalPlan {
  bool drop_all = false;
  std::vector<std::uint8_t> stale;  // #vn, whether to replace the normal
  Points renewed;                   // #vn x 3
};

/// Computes each normal from the faces whose corners refer to it: on a crease, one vertex has
/// several normals, one for each side.
NormalPlan plan_normals(const PatchRequest& request, const CornerReferences& references) {
  const Polygons& faces = request.mesh.faces;
  const std::vector<std::uint8_t> changed = faces_touching(faces, request.moved);
  const std::size_t count = references.normals.size();
  NormalPlan plan;
  plan.stale.assign(count, 0);
  plan.renewed = Points::Zero(static_cast<Eigen::Index>(count), 3);
  Points before = plan.renewed;
  std::vector<Index> owner(count, -1);
  std::vector<std::uint8_t> shared(count, 0);
  for (Index f = 0; f < faces.size(); ++f) {
    const Vec3 area_before = polygon_area_vector(request.mesh.X, faces[f]);
    const Vec3 area_after = polygon_area_vector(request.X, faces[f]);
    for (std::int64_t i = faces.first[f]; i < faces.first[f + 1]; ++i) {
      const Index n = references.corner_normal[i];
      if (n < 0) continue;
      const auto at = static_cast<std::size_t>(n);
      const Index vertex = faces.corner[i];
      if (owner[at] >= 0 && owner[at] != vertex) shared[at] = 1;
      owner[at] = vertex;
      before.row(n) += area_before;
      plan.renewed.row(n) += area_after;
      if (changed[f] != 0) plan.stale[at] = 1;
    }
  }
  for (std::size_t n = 0; n < count; ++n) {
    if (plan.stale[n] == 0) continue;
    if (shared[n] != 0) plan.drop_all = true;
    const auto row = static_cast<Eigen::Index>(n);
    const Vec3 old(references.normals[n].data());
    const double length = plan.renewed.row(row).norm();
    if (!(length > 0.0)) {
      plan.renewed.row(row) = old;
    } else {
      plan.renewed.row(row) /= old.dot(before.row(row)) < 0.0 ? -length : length;
    }
  }
  return plan;
}

/// Replaces those of the next three numbers of the statement for which changed(c) is true.
template <class Changed>
void replace_numbers(ObjScanner& scan, BytePatcher& text, const Points& X, Eigen::Index row,
                     Changed changed) {
  for (int c = 0; c < 3; ++c) {
    const char* start = scan.position();
    scan.skip_argument();
    if (changed(c)) text.replace(start, scan.position_after(), X(row, c));
  }
}

/// Turns the face corners `a/b/c` into `a/b`, and `a//c` into `a`.
void remove_normals(ObjScanner& scan, BytePatcher& text) {
  while (!scan.at_statement_end()) {
    const char* start = scan.position();
    scan.corner();
    const std::string_view corner(start, static_cast<std::size_t>(scan.position_after() - start));
    const std::size_t second = corner.find('/', corner.find('/') + 1);
    if (corner.find('/') == std::string_view::npos || second == std::string_view::npos) continue;
    const std::size_t keep = corner[second - 1] == '/' ? second - 1 : second;
    text.remove(start + keep, scan.position_after());
  }
}

/// Copies the text with moved vertices and stale normals replaced, or with all normals removed.
void patch_text(const PatchRequest& request, const NormalPlan& normals, ByteSink& out) {
  BytePatcher text(request.source, out);
  ObjScanner scan(request.source);
  Eigen::Index vertex = 0;
  std::size_t normal = 0;
  const bool plain = ObjScanner::has_plain_lines(request.source);
  for (; scan.next_statement(); plain ? scan.skip_plain_line() : void()) {
    const std::string_view keyword = scan.keyword();
    if (keyword == "v") {
      const Points& before = request.mesh.X;
      if (request.moved[vertex] != 0) {
        replace_numbers(scan, text, request.X, vertex,
                        [&](int c) { return request.X(vertex, c) != before(vertex, c); });
      }
      ++vertex;
    } else if (keyword == "vn") {
      if (normals.drop_all) {
        text.remove(scan.statement_start(), scan.after_statement());
      } else if (normals.stale[normal] != 0) {
        replace_numbers(scan, text, normals.renewed, static_cast<Eigen::Index>(normal),
                        [](int) { return true; });
      }
      ++normal;
    } else if (keyword == "f" && normals.drop_all) {
      remove_normals(scan, text);
    }
  }
  text.finish();
}

}  // namespace

std::vector<std::string> patch(const PatchRequest& request, ByteSink& out) {
  NormalPlan normals;
  std::vector<std::string> notes;
  if (request.any_moved) {
    if (request.has_normals) {
      normals = plan_normals(request, read_corner_references(request.source));
    }
    patch_text(request, normals, out);
  } else {
    out.write(request.source.view());
  }
  if (request.extension != nullptr) {
    notes = append(request, request.has_normals && !normals.drop_all, out);
  }
  if (normals.drop_all) {
    notes.emplace_back(
        "dropped the normals: some are shared by several vertices, for which they are no longer "
        "right");
  }
  return notes;
}

}  // namespace ibmfair::obj
