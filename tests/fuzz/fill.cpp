// For any mesh and options, filling the holes adds sound triangles with finite positions and moves
// no vertex that it should not move; a hole that is reported as filled is closed. A second run
// gives the same bits.
#include <algorithm>
#include <array>
#include <set>

#include "fuzz/small_mesh.h"
#include "fuzz/targets.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/fill/fill_holes.h"

namespace ibmfair::fuzz {

namespace {

FillOptions fill_options(Bytes& bytes, HoleChoice& choice) {
  constexpr Index most = 60;  // vertices; more would only take longer
  FillOptions options;
  const std::uint8_t kinds = bytes.next();
  options.fairing.laplacian = (kinds & 1) == 0 ? "lagrange" : "crouzeix-raviart";
  options.fairing.mass = (kinds & 2) == 0;
  options.refine = (kinds & 4) == 0;
  options.fair = (kinds & 8) == 0;
  choice.all = (kinds & 16) == 0;
  options.continuity = (kinds & 32) == 0  ? Continuity::curvature
                       : (kinds & 2) == 0 ? Continuity::tangents
                                          : Continuity::positions;
  if ((kinds & 64) != 0) {
    choice.bridges.push_back({0, 1});
  }
  options.edge_length = (kinds & 128) != 0 ? 0.3 : 0;
  options.sharp_angle = (bytes.next() & 1) != 0 ? 0.3 : 0;
  options.rim_smooth = bytes.below(3);
  options.fairing.most_steps = 10;
  options.most_new_vertices = 1 + bytes.below(most);
  return options;
}

bool in_range(const std::vector<Index>& numbers, Eigen::Index count) {
  return std::all_of(numbers.begin(), numbers.end(), [&](Index n) { return n >= 0 && n < count; });
}

/// The sizes and indices of the filling agree with each other and with the mesh.
void require_fit(const Filling& filling, const Mesh& mesh, const Topology& topology) {
  const auto holes = static_cast<Eigen::Index>(find_holes(mesh.X, topology).size());
  const Eigen::Index vertices = mesh.X.rows() + filling.new_X.rows();
  law(filling.X.rows() == mesh.X.rows(), "no vertex is lost");
  law(filling.X.allFinite() && filling.new_X.allFinite(), "all ends in finite places");
  law(filling.new_F.size() == 0 ||
          (filling.new_F.minCoeff() >= 0 && filling.new_F.maxCoeff() < vertices),
      "corners are vertices");
  for (Eigen::Index f = 0; f < filling.new_F.rows(); ++f) {
    const auto corner = filling.new_F.row(f);
    law(corner[0] != corner[1] && corner[1] != corner[2] && corner[2] != corner[0],
        "a new triangle has three corners");
  }
  const auto triangles = static_cast<std::size_t>(filling.new_F.rows());
  law(filling.model_triangle.size() == triangles && filling.hole_of_triangle.size() == triangles,
      "every new triangle has a hole and a model");
  law(in_range(filling.model_triangle, topology.F.rows()), "models are triangles of the mesh");
  law(in_range(filling.hole_of_triangle, holes), "new triangles belong to holes");
  law(static_cast<Eigen::Index>(filling.holes.size()) == holes, "every hole is reported");
  law(in_range(filling.rim(), mesh.X.rows()), "the rim is of the mesh");
}

/// Values at the rim are extended to the new vertices without leaving their range.
void require_extension(const Filling& filling) {
  const auto rim = static_cast<Eigen::Index>(filling.rim().size());
  if (filling.new_X.rows() == 0 || rim == 0) return;
  const Eigen::MatrixXd ones = filling.extend(Eigen::MatrixXd::Ones(rim, 2));
  law(ones.rows() == filling.new_X.rows() && ones.cols() == 2, "every new vertex gets a value");
  const auto is_one = (ones.array() - 1).abs() < 1e-6;
  law((is_one || ones.array().isNaN()).all(), "constants extend to themselves");
}

/// Every edge along a filled hole has triangles on both sides.
void require_closed(const Filling& filling, const Topology& topology) {
  FilledMesh filled = filled_mesh(topology, filling);
  const Topology after = build_topology(filled.X, std::move(filled.F));
  std::set<std::array<Index, 2>> open;
  for (Index e = 0; e < after.E.rows(); ++e) {
    if (after.edge_triangles[e].size() == 1) open.insert({after.E(e, 0), after.E(e, 1)});
  }
  for (const Hole& hole : find_holes(filling.X, topology)) {
    if (filling.holes[hole.id].status != HoleStatus::filled) continue;
    const std::vector<Index>& loop = hole.loop;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const auto [a, b] = std::minmax(loop[i], loop[(i + 1) % loop.size()]);
      law(!open.contains({a, b}), "a filled hole is closed");
    }
  }
}

bool same(const Filling& a, const Filling& b) {
  const auto same_report = [](const HoleReport& x, const HoleReport& y) {
    return x.status == y.status && x.reason == y.reason && x.intersections == y.intersections;
  };
  return a.X == b.X && a.new_X == b.new_X && a.new_F == b.new_F &&
         a.model_triangle == b.model_triangle &&
         std::equal(a.holes.begin(), a.holes.end(), b.holes.begin(), b.holes.end(), same_report);
}

}  // namespace

void fill(std::string_view input) {
  Bytes bytes(input);
  HoleChoice choice;
  const FillOptions options = fill_options(bytes, choice);
  const Mesh mesh = small_mesh(bytes);
  if (mesh.faces.size() == 0) return;  // no reader returns such a mesh
  const Topology topology = build_topology(mesh.X, triangulate(mesh).F);
  Filling filling;
  try {
    filling = fill_holes(mesh.X, topology, choice, options);
  } catch (const Error& error) {
    law(*error.what() != '\0', "a refusal says why");
    return;
  }
  require_fit(filling, mesh, topology);
  law(options.rim_smooth > 0 || filling.X == mesh.X, "the mesh stays as it is");
  require_extension(filling);
  require_closed(filling, topology);
  law(same(filling, fill_holes(mesh.X, topology, choice, options)), "the same comes out again");
}

}  // namespace ibmfair::fuzz
