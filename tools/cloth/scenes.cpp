#include "cloth/scenes.h"

#include <array>

#include "ibmfair/base/named_row.h"

namespace ibmfair::cloth {
namespace {

constexpr double unevenness = 0.03;  // 1/m^3

/// Heavily damped, because only the final rest state is of interest.
Scene drape(const TriangleMesh& sheet) {
  const Material material{
      .density = 0.2, .young = 1000, .bending = 3e-4, .mass_damping = 4, .strain_damping = 1e-3};
  Scene scene;
  Sphere sphere;
  sphere.radius = 0.2;
  scene.surroundings.sphere = sphere;
  Points X(sheet.X.rows(), 3);
  X << sheet.X.col(0).array() - 0.5, Eigen::VectorXd::Constant(X.rows(), sphere.resting_radius()),
      0.5 - sheet.X.col(1).array();
  scene.plate = make_plate(X, sheet.F, material);
  scene.start = X;
  // The corners start slightly lower, so that the sheet folds at the middle of its sides.
  const auto x = X.col(0).array(), z = X.col(2).array();
  scene.start.col(1).array() -= unevenness * x.square() * z.square();
  return scene;
}

/// The left side of the sheet is fixed, and the wind blows along the sheet and slightly across.
Scene flag(const TriangleMesh& sheet) {
  const Material material{
      .density = 0.1, .young = 1000, .bending = 2e-4, .mass_damping = 0, .strain_damping = 1e-4};
  Scene scene;
  std::vector<std::uint8_t> fixed;
  for (const double x : sheet.X.col(0)) {
    fixed.push_back(x == 0 ? 1 : 0);
  }
  scene.plate = make_plate(sheet.X, sheet.F, material, fixed);
  scene.surroundings.wind = {15, 0, 0.5};
  scene.surroundings.drag = 0.5;
  scene.start = sheet.X;
  return scene;
}

const std::array scene_table{
    SceneRow{"drape", "a sheet falls over a sphere, heavily damped", drape, 2, 0.01,
             View{{0.5, 0.55, 1}}},
    SceneRow{"flag", "a flag held along one side, in a constant wind", flag, 3, 0.005,
             View{{0.35, 0.25, 1}}},
};

}  // namespace

std::span<const SceneRow> scenes() {
  return scene_table;
}

const SceneRow& scene(std::string_view name) {
  return row_named(scenes(), "scene", name);
}

}  // namespace ibmfair::cloth
