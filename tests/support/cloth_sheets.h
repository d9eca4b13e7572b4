// Small sheets and their energies, for the tests of tools/cloth.
#pragma once

#include <cmath>
#include <memory>
#include <string_view>
#include <vector>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "cloth/elastic_sheet.h"
#include "cloth/plate.h"
#include "cloth/sheet_meshes.h"
#include "support/states.h"

namespace ibmfair::cloth::test {

using namespace ibmfair::test;  // random_directions

/// A part of the elastic energy, by name.
struct TermRow {
  std::string_view name;
  std::unique_ptr<EnergyTerm> (*create)(const Plate& plate, const BlockHessian& H);
};

inline std::vector<TermRow> terms() {
  std::vector<TermRow> rows{{"membrane", bind_membrane}};
  for (const BendingForce& force : bending_forces()) {
    rows.push_back({force.name, force.create});
  }
  return rows;
}

/// A sheet of about 60 vertices and side 1 m.
inline Plate small_plate(const SheetMesh& mesh, const Material& material = {}) {
  const TriangleMesh sheet = mesh.make(64);
  return make_plate(sheet.X, sheet.F, material);
}

/// The sheet bent in both directions, and sheared and stretched a little.
inline Points crumpled(const Points& X) {
  Points Y = X;
  Y.col(2) = 0.2 * (7 * X.col(0).array() + 1).sin() * (5 * X.col(1).array()).cos();
  Y.col(0) += 0.05 * (4 * X.col(1).array()).sin().matrix();
  Y.col(1) += 0.1 * X.col(0).cwiseProduct(X.col(1));
  return Y;
}

/// The Hessian as a dense matrix, 3 #V x 3 #V.
inline Eigen::MatrixXd dense(const BlockHessian& H) {
  const Index size = 3 * H.vertices();
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(size, size);
  for (Index j = 0; j < H.vertices(); ++j) {
    for (auto k = H.pattern().column_first[j]; k < H.pattern().column_first[j + 1]; ++k) {
      const auto i = static_cast<Index>(H.pattern().row[k]);
      M.block<3, 3>(3 * i, 3 * j) = H.blocks()[k];
      M.block<3, 3>(3 * j, 3 * i) = H.blocks()[k].transpose();
    }
  }
  return M;
}

}  // namespace ibmfair::cloth::test
