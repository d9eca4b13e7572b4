#include "petsc_engine/piece_measures.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/flow/folds.h"
#include "ibmfair/flow/part_measures.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair::petsc {
namespace {

double volume(const MeshPiece& piece, const Points& X, const PetscParts& parts) {
  Vec3 centre = Vec3::Zero();
  for (int c = 0; c < 3; ++c) {
    centre[c] =
        parts.sum(X.col(c).head(piece.own).sum()) / static_cast<double>(piece.vertices.total);
  }
  double sum = 0;
  for (Index t = 0; t < piece.F.rows(); ++t) {
    if (piece.own_triangle[t]) {
      const Vec3 a = X.row(piece.F(t, 0)), b = X.row(piece.F(t, 1)), c = X.row(piece.F(t, 2));
      sum += (a - centre).dot((b - centre).cross(c - centre)) / 6;
    }
  }
  return parts.sum(sum);
}

double smallest_angle(const Topology& topology, const MeshPiece& piece, const Points& X,
                      const PetscParts& parts) {
  const Eigen::VectorXd angles = smallest_angles(X, topology.F);
  double largest_negative = -std::numbers::pi;
  for (Index t = 0; t < angles.size(); ++t) {
    if (piece.own_triangle[t]) {
      largest_negative = std::max(largest_negative, -angles[t]);
    }
  }
  return -parts.max(largest_negative) * 180 / std::numbers::pi;
}

std::int64_t folds(const Topology& topology, const Points& X, const PetscParts& parts) {
  const Eigen::VectorXd angles = dihedral_angles(X, topology.H);
  double count = 0;
  for (Index h = 0; h < angles.size(); ++h) {
    count += angles[h] < fold_angle ? own_share({topology.H.row(h).data(), 4}, parts) : 0;
  }
  return std::llround(parts.sum(count));
}

struct DefectKind {
  const char* what;
  double count;  // what belongs to this part
};

}  // namespace

commands::MeshFigures mesh_figures(const MeshPiece& piece, const Points& X,
                                   const Topology& topology, const FlowOptions& options,
                                   const PetscParts& parts) {
  EnergyOptions energy = options.energy_options();
  energy.own_vertices = parts.own_vertices();
  energy.own_triangles = parts.own_triangles();
  commands::MeshFigures figures;
  figures.energy = parts.sum(bending_model(options.laplacian).bind(topology, energy)->energy(X));
  figures.area = surface_area(X, topology, parts);
  figures.volume = volume(piece, X, parts);
  figures.smallest_angle = smallest_angle(topology, piece, X, parts);
  figures.folds = folds(topology, X, parts);
  return figures;
}

std::vector<commands::Warning> defect_warnings(const Topology& topology, const MeshPiece& piece,
                                               const PetscParts& parts, bool strict) {
  const Defects& defects = topology.defects;
  const auto own_triangles = [&piece](const std::vector<Index>& list) {
    return static_cast<double>(
        std::count_if(list.begin(), list.end(), [&](Index t) { return piece.own_triangle[t]; }));
  };
  double edges = 0;
  for (const Index e : defects.non_manifold_edges) {
    edges += own_share({topology.E.row(e).data(), 2}, parts);
  }
  const auto bow_ties = static_cast<double>(
      std::count_if(defects.bow_tie_vertices.begin(), defects.bow_tie_vertices.end(),
                    [&parts](Index v) { return parts.owns_vertex(v); }));
  std::vector<commands::Warning> warnings;
  for (const DefectKind& kind :
       {DefectKind{"triangles with a repeated corner", own_triangles(defects.repeated_corner)},
        DefectKind{"triangles without area", own_triangles(defects.zero_area)},
        DefectKind{"triangles over the same vertices as another", own_triangles(defects.duplicate)},
        DefectKind{"edges of three or more triangles", edges},
        DefectKind{"bow-tie vertices", bow_ties}}) {
    if (const auto count = std::llround(parts.sum(kind.count)); count > 0) {
      const std::string text = fmt::format("{} {}", count, kind.what);
      if (strict) {
        throw BadMesh(text);
      }
      warnings.push_back({text + ": left out of the energy, their vertices are held"});
    }
  }
  return warnings;
}

}  // namespace ibmfair::petsc
